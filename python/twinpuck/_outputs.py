# SPDX-License-Identifier: MIT
"""Files that a command writes: what is wrong with them before it begins, and what is told when one is lost."""
from __future__ import annotations

import collections.abc
import os
import pathlib
import stat
import typing

Option = tuple[typing.Union[str, "os.PathLike[str]", None], str]  # path or None, and the option that names it


def conflicts(outputs: collections.abc.Sequence[Option], inputs: collections.abc.Iterable[pathlib.Path] = ()) -> list[str]:
    """Outputs that are one file or folder, or that are there already and are, or lie in, one of `inputs`."""
    problems: list[str] = []
    taken: dict[typing.Any, str] = {}
    folders = [pathlib.Path(os.path.realpath(path)) for path in inputs]
    for path, option in outputs:
        if not path or os.fspath(path).startswith("/dev/"):
            continue
        whole, exists = pathlib.Path(os.path.realpath(path)), os.path.exists(path)
        first = taken.setdefault(_identity(whole), option)
        if first != option:
            problems.append(f"{path}: {option}: got the file of {first}, expected another; give them different names")
        elif exists and any(whole == folder or folder in whole.parents for folder in folders):
            problems.append(f"{path}: {option}: got what is there already for the run to read, "
                            "expected another place")
    return problems


def unwritable(files: collections.abc.Iterable[Option]) -> list[str]:
    """Files that cannot be written."""
    return [wrong for path, option in files if path and (wrong := _unwritable(os.fspath(path), option))]


def wrong_folder(folder: str | os.PathLike[str], option: str) -> str:
    """Why a folder cannot be made or be written to; empty: it can, and is there."""
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as wrong:
        why = wrong.strerror
    else:
        if os.access(folder, os.W_OK | os.X_OK):
            return ""
        why = "Permission denied"
    return f"{folder}: {option}: got '{why}', expected a folder, or a place where one can be made"


def lost(name: str, wrong: OSError) -> str:
    """One line for an output that has just been lost."""
    why = wrong.args[0][0][2] if not wrong.strerror and wrong.args and isinstance(wrong.args[0], list) else wrong.strerror
    return f"{name}: cannot be written: {why or wrong}"


def _identity(path: pathlib.Path) -> typing.Any:
    try:
        status = path.stat()
    except OSError:
        return path
    return status.st_dev, status.st_ino


def _unwritable(path: str, option: str) -> str:
    try:
        if not os.path.exists(path):  # it is not made: another process may write it meanwhile
            folder = os.path.dirname(path) or "."
            os.stat(os.path.join(folder, ""))  # says what is wrong with it
            why = "" if os.access(folder, os.W_OK | os.X_OK) else "Permission denied"
        # one that the shell made is open already; opening another would wait for its reader
        elif not path.startswith("/dev/") and stat.S_ISFIFO(os.stat(path).st_mode):
            why = "a pipe"
        else:
            with open(path, "ab"):
                why = ""
    except OSError as wrong:
        why = wrong.strerror
    return f"{path}: {option}: got '{why}', expected a file that can be written" if why else ""
