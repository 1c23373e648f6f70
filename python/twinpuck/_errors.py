# SPDX-License-Identifier: MIT
"""What can go wrong, as exceptions. All are TwinpuckErrors."""
from __future__ import annotations

import typing

if typing.TYPE_CHECKING:
    from ._robot import Trap


class TwinpuckError(Exception):
    """Anything that Twinpuck has to say against what it was asked."""

    __module__ = "twinpuck"


class WorldError(TwinpuckError, ValueError):
    """A world cannot be opened: its text, a program's source or an option is wrong.

    problems: a line each, "file:line: what: got ..., expected ..."
    """

    __module__ = "twinpuck"

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.problems = text.splitlines()


class FirmwareFault(TwinpuckError):
    """A program trapped, or the robot was reset unexpectedly. The world stands; time is the trap's or up to 1/64 s later.

    trap: which robot, what, and where in its source
    """

    __module__ = "twinpuck"

    def __init__(self, trap: Trap) -> None:
        super().__init__(str(trap))
        self.trap = trap


class ExpectTimeout(TwinpuckError, AssertionError):
    """What SerialLine.expect() waits for did not come in time."""

    __module__ = "twinpuck"


class OutputLost(TwinpuckError, RuntimeError):
    """Counts of lines could not be written, or are of other sources; a line for each problem."""

    __module__ = "twinpuck"


class InvalidRun(TwinpuckError):
    """A fault or stimulus of the run never took effect, or a condition was never looked at, so the run shows nothing; a line
    for each."""

    __module__ = "twinpuck"
