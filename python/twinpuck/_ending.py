# SPDX-License-Identifier: MIT
"""How `twinpuck test` and `twinpuck grade` end where somebody does not want the rest, without a traceback: exit code 130
by a signal, whenever it comes, and 7 where nobody reads what they say.

The command has all of SIGNALS held back while it becomes Python, and Python reads its modules: run() lets them come.
"""
from __future__ import annotations

import collections.abc
import os
import signal
import sys
import types
import typing

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
INTERRUPTED, INVALID = 130, 7


_came: list[int] = []


def _interrupt(number: int, _frame: types.FrameType | None) -> typing.NoReturn:
    _came.append(number)
    raise KeyboardInterrupt


def was_interrupted() -> bool:
    """Also where somebody took the exception for another one: pytest does while it imports a file of tests."""
    return bool(_came)


def _end(_number: int, _frame: types.FrameType | None) -> typing.NoReturn:
    os._exit(INTERRUPTED)


def run(main: collections.abc.Callable[[list[str]], int]) -> typing.NoReturn:
    """Ends the process with what `main` returns, or as above."""
    code, ours = INTERRUPTED, [number for number in SIGNALS if signal.getsignal(number) is not signal.SIG_IGN]  # of nohup
    try:
        for number in ours:
            signal.signal(number, _interrupt)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
        code = main(sys.argv[1:])
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:
        print("standard output: cannot be written any more; it ended there", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what is left of it is not tried again
        code = INVALID
    for number in ours:  # what is left is Python's own
        signal.signal(number, _end)
    sys.exit(code)
