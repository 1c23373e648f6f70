# SPDX-License-Identifier: MIT
"""Recordings of runs as arrays of NumPy and tables of pandas."""
from __future__ import annotations

import os
import typing

if typing.TYPE_CHECKING:
    import numpy
    import pandas

_FIELDS = [("time_s", float), ("robot", "U64"), ("x_m", float), ("y_m", float), ("heading_rad", float),
           ("left_steps", "i8"), ("right_steps", "i8"), *((f"ir{i}", "i4") for i in range(8)), ("leds", "i4")]


class Recording:
    """Rows of all robots at multiples of a time, taken while the world runs.

    Columns: time_s (s), robot (its name), x_m, y_m (m), heading_rad (rad), left_steps, right_steps, ir0 to ir7
    (counts; 0 where the robot has no such sensor), leds (bits 0 to 7 the ring, 8 body, 9 front) and battery_v (V).
    """

    def __init__(self, core: typing.Any, names: list[str]) -> None:
        self._core, self._names = core, names

    @property
    def array(self) -> numpy.ndarray:
        """All rows so far, as a structured array: `recording.array["x_m"]`. A copy."""
        import numpy  # it takes a while, and most tests need none

        rows = self._core.rows
        array = numpy.zeros(len(rows), dtype=_FIELDS + [("battery_v", float)])
        for column, (name, _) in enumerate(_FIELDS + [("battery_v", float)]):
            if name == "robot":
                array[name] = numpy.asarray(self._names)[rows[:, column].astype(int)]
            else:
                array[name] = rows[:, column]
        return array

    def of(self, robot: str) -> numpy.ndarray:
        """The rows of one robot, by its name."""
        array = self.array
        return array[array["robot"] == robot]

    def frame(self) -> pandas.DataFrame:
        """All rows so far as a table of pandas, which must be installed (Debian: python3-pandas)."""
        import pandas  # most users need none

        return pandas.DataFrame(self.array)


def read_recording(path: str | os.PathLike[str]) -> numpy.ndarray:
    """What `twinpuck run --record FILE` wrote, as a structured array with the columns of Recording but battery_v.

    Raises OSError where the file cannot be read, ValueError where it is no recording.
    """
    import numpy

    with open(path, encoding="utf-8") as file:
        header = file.readline().strip().split(",")
        expected = [name for name, _ in _FIELDS]
        if header != expected:
            raise ValueError(f"{os.fspath(path)}: got columns {header}, expected {expected}")
        import csv

        rows = []
        for line, row in enumerate(csv.reader(file), 2):
            try:
                rows.append(tuple(text if name == "robot" else int(text, 16) if name == "leds" else float(text or 0)
                                  for name, text in zip(expected, row, strict=True)))
            except ValueError:
                raise ValueError(f"{os.fspath(path)}:{line}: got {','.join(row)!r}, expected a name and {len(expected) - 1} "
                                 "numbers; is the file cut off?") from None
    return numpy.array(rows, dtype=_FIELDS)
