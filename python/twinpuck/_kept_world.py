# SPDX-License-Identifier: MIT
"""A world that a test has: the plug-in can ask it until the test is over, also when the test has closed it."""
from __future__ import annotations

import copy
import typing

from ._errors import OutputLost
from ._world import World


class KeptWorld(World):
    """A world whose close() ends what the test may do with it; what it came to is kept until drop()."""

    __slots__ = ("_kept", "lost")

    def __init__(self, *arguments: typing.Any, **options: typing.Any) -> None:
        __tracebackhide__ = True
        self._kept: typing.Any = None
        self.lost: list[str] | None = None  # takes outputs that are lost, a line each; None: close() raises OutputLost
        super().__init__(*arguments, **options)

    def close(self) -> None:
        """As World's."""
        problems, kept = self._core.close_and_keep()
        self._kept = kept or self._kept
        if problems and self.lost is None:
            raise OutputLost(problems)
        if problems and self.lost is not None:
            self.lost += problems.splitlines()

    def reset(self, seed: int | None = None) -> None:
        """As World's."""
        super().reset(seed)
        self._kept = None

    def as_it_came_to_be(self) -> World:
        """Itself while it is open, else the world as it was when the test closed it."""
        if self._core.is_open or self._kept is None:
            return self
        ended = copy.copy(self)
        ended._core, ended._robots = self._kept, {}  # robots are asked through their world
        return ended

    def drop(self) -> None:
        """The test is over: closed, and nothing is kept."""
        try:
            self.close()
        finally:
            self._kept = None
