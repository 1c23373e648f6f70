# SPDX-License-Identifier: MIT
"""What a test runs over: seeds, HALs and positions of the selector, from the command line or a marker."""
from __future__ import annotations

import collections.abc
import dataclasses
import re
import typing

_MOST = 100_000  # runs of one test


@dataclasses.dataclass(frozen=True)
class Axis:
    """One thing that varies. name: in a test's name; option: of the command line, without dashes; least, most: of numbers; None: it is one of the words."""

    name: str
    option: str
    marker: str
    least: int = 0
    most: int = 0
    words: tuple[str, ...] = ()

    @property
    def fixture(self) -> str:
        """What pytest calls it."""
        return f"_{self.name}"

    def values(self, text: str | None) -> list[typing.Any]:
        """"1..50", "1,2,7" or "sim,dspic" as a list; of None: []. Raises ValueError."""
        return [] if text is None else self.marked([text])

    def marked(self, arguments: collections.abc.Iterable[typing.Any] | None) -> list[typing.Any]:
        """The same of a marker's arguments, which may be numbers, words, texts with commas and ranges, and lists."""
        if arguments is None:
            return []
        values = self._all(arguments)
        if not values:
            raise ValueError(f"--{self.option}: got none, expected one or more")
        if len(values) > _MOST:
            raise ValueError(f"--{self.option}: got {len(values)} runs, expected at most {_MOST}")
        return list(dict.fromkeys(values))

    def _all(self, arguments: collections.abc.Iterable[typing.Any]) -> list[typing.Any]:
        values: list[typing.Any] = []
        for argument in arguments:
            if isinstance(argument, str):
                for part in argument.split(","):
                    values += self._part(part.strip())
            elif isinstance(argument, collections.abc.Iterable):
                values += self._all(argument)
            else:
                values += self._part(str(argument))
        return values

    def _part(self, part: str) -> list[typing.Any]:
        if self.words:
            if part not in self.words:
                raise ValueError(f"--{self.option}: got {part!r}, expected {' or '.join(self.words)}")
            return [part]
        match = re.fullmatch(r"(\d{1,18})(?:\.\.(\d{1,18}))?", part)
        first, last = (int(match[1]), int(match[2] or match[1])) if match else (0, -1)
        if not self.least <= first <= last <= self.most or last - first >= _MOST:
            raise ValueError(f"--{self.option}: got {part!r}, expected numbers from {self.least} to {self.most}, such as "
                             f"{self.least}..{self.least + 9} or {self.least},{self.least + 1}")
        return list(range(first, last + 1))


AXES = (
    Axis("seed", "seeds", "seeds", 0, 10**18 - 1),
    Axis("hal", "hal", "hals", words=("sim", "dspic")),
    Axis("selector", "selector", "selectors", 0, 15),
)
