# SPDX-License-Identifier: MIT
"""How `twinpuck test` and `twinpuck grade` end where somebody does not want the rest, without a traceback: exit code 130
by a signal, whenever it comes, and 7 where nobody reads what they say.

The command has all of SIGNALS held back while it becomes Python; run() lets them come. Until something can be lost they
end the process at once: while Python imports modules an exception may come in a callback that swallows it, or in exec(),
after which Python ends by SIGINT. From heed_work() on they are a KeyboardInterrupt, again and again until somebody has
ended by it.
"""
from __future__ import annotations

import atexit
import collections.abc
import contextlib
import errno
import os
import signal
import sys
import types
import typing

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT)
INTERRUPTED, INVALID = 130, 7
_AGAIN_S = 2.0  # much longer than pytest takes from the exception to its end of a test

_came: list[int] = []


def _interrupt(number: int, _frame: types.FrameType | None) -> typing.NoReturn:
    _came.append(number)
    signal.signal(signal.SIGALRM, _interrupt)  # limits of tests have had their own
    signal.setitimer(signal.ITIMER_REAL, _AGAIN_S)  # who swallows it has another one
    raise KeyboardInterrupt


def has_ended() -> None:
    """Somebody ends by the interruption: it is not repeated."""
    signal.setitimer(signal.ITIMER_REAL, 0)


def heed_work() -> None:
    """From here something can be lost: signals become exceptions."""
    for number in heeded():
        if signal.getsignal(number) is _end:  # not somebody's own
            signal.signal(number, _interrupt)


def was_interrupted() -> bool:
    """Also where somebody took the exception for another one, as a test that catches all does."""
    return bool(_came)


def _end(_number: int, _frame: types.FrameType | None) -> typing.NoReturn:
    os._exit(INTERRUPTED)


def heeded() -> list[signal.Signals]:
    """Those of SIGNALS that end anything: nohup has some ignored."""
    return [number for number in SIGNALS if signal.getsignal(number) is not signal.SIG_IGN]


class _Said:
    """Standard output: what cannot be written ends the command, and is told once."""

    def __init__(self) -> None:
        self.why = ""
        if sys.stdout is None:  # it is closed
            self.why = ": " + os.strerror(errno.EBADF)
            self._go_on_into_nothing()
            sys.stdout = os.fdopen(1, "w", closefd=False)
        self._stream = sys.stdout

    def write(self, text: str) -> int:
        return self._heed(lambda: self._stream.write(text), len(text))

    def flush(self) -> None:
        self._heed(self._stream.flush, None)

    def __getattr__(self, name: str) -> typing.Any:
        return getattr(self._stream, name)

    def _heed(self, do: collections.abc.Callable[[], typing.Any], otherwise: typing.Any) -> typing.Any:
        try:
            return do()
        except OSError as wrong:
            if self.why:
                return otherwise
            self.why = f": {wrong.strerror}"
            if isinstance(wrong, BrokenPipeError):
                self.why = " any more; it ended there"
            self._go_on_into_nothing()
            raise KeyboardInterrupt from None

    @staticmethod
    def _go_on_into_nothing() -> None:
        nothing = os.open(os.devnull, os.O_WRONLY)
        if nothing != 1:
            os.dup2(nothing, 1)
            os.close(nothing)


def run(main: collections.abc.Callable[[list[str]], int], *, needs_output: bool = False) -> typing.NoReturn:
    """Ends the process with what `main` returns, or as above. `needs_output`: `main` ends where it cannot say any more,
    and does not see to that itself."""
    code, ours = INTERRUPTED, heeded()
    for number in ours:
        signal.signal(number, _end)
    said = _Said() if needs_output else None
    if said:
        sys.stdout = typing.cast(typing.TextIO, said)
    try:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, SIGNALS)
        code = main(sys.argv[1:])
        if said:
            said.flush()
    except KeyboardInterrupt:
        pass
    except BrokenPipeError:
        print("standard output: cannot be written any more; it ended there", file=sys.stderr)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # what is left of it is not tried again
        code = INVALID
    has_ended()
    if said and said.why and not was_interrupted():
        print("standard output: cannot be written" + said.why, file=sys.stderr)
        code = INVALID
    for number in ours:  # what is left is Python's own
        signal.signal(number, _end)
    if code == INTERRUPTED:  # sys.exit() would be the death by SIGINT where the exception has passed exec() of a text
        atexit._run_exitfuncs()
        for stream in filter(None, (sys.stdout, sys.stderr)):
            with contextlib.suppress(OSError):
                stream.flush()
        os._exit(code)
    sys.exit(code)
