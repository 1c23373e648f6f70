# SPDX-License-Identifier: MIT
"""Faults and stimuli of a run (docs/testing.md, `twinpuck list faults`)."""
from __future__ import annotations

import typing

from ._errors import TwinpuckError

if typing.TYPE_CHECKING:
    from ._world import World


class Fault:
    """A fault or stimulus that was asked for. Times are simulated (s); None: not, or not yet."""

    __slots__ = ("_world", "_number", "_run")

    def __init__(self, world: World, number: int) -> None:
        self._world, self._number, self._run = world, number, world._core

    def _is_of_before(self) -> bool:
        return self._run is not self._world._core

    def _status(self) -> dict[str, typing.Any]:
        if self._is_of_before():
            raise TwinpuckError(f"fault {self._number}: belongs to the run before reset(), expected one of this run")
        return self._run.fault(self._number)

    @property
    def begun_s(self) -> float | None:
        """When it began."""
        return self._status()["begun_s"]

    @property
    def took_effect_s(self) -> float | None:
        """When it first changed something for the program or the world."""
        return self._status()["took_effect_s"]

    @property
    def ended_s(self) -> float | None:
        """When it ended."""
        return self._status()["ended_s"]

    def end(self) -> None:
        """Ends it now; one that has not begun never will."""
        self._status()
        self._world._apply({"do": "end_fault", "fault": self._number})

    def __repr__(self) -> str:
        if self._is_of_before():
            return f"<Fault {self._number} of the run before reset()>"
        status = self._status()
        times = ", ".join(f"{name.removesuffix('_s').replace('_', ' ')} at {status[name]:.3f} s"
                          for name in ("begun_s", "took_effect_s", "ended_s") if status[name] is not None)
        return f"<Fault {status['what']}: {times or 'not begun'}>"
