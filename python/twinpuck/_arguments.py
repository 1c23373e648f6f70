# SPDX-License-Identifier: MIT
"""What Twinpuck's methods are given: checked by their annotations, and made what those say, in one place for all of them."""
from __future__ import annotations

import collections.abc
import functools
import inspect
import os
import re
import typing

_Class = typing.TypeVar("_Class", bound=type)
Function = collections.abc.Callable[..., typing.Any]


class Unfit(Exception):
    """A value is not what it should be."""


def whole(value: typing.Any) -> int:
    """Also of NumPy."""
    if isinstance(value, bool) or not hasattr(value, "__index__"):
        raise Unfit
    return value.__index__()


def number(value: typing.Any) -> float:
    """Also of NumPy; a whole one stays one."""
    if isinstance(value, (bool, str)) or not hasattr(value, "__float__"):
        raise Unfit
    return value if isinstance(value, (int, float)) else float(value)


def truth(value: typing.Any) -> bool:
    """Also 0 and 1, and those of NumPy."""
    if isinstance(value, str) or not hasattr(value, "__bool__") or value not in (0, 1):
        raise Unfit
    return bool(value)


def text(value: typing.Any) -> str:
    """Without halves of characters, which no file can hold."""
    if not isinstance(value, str):
        raise Unfit
    if re.search("[\ud800-\udfff]", value):
        raise ValueError("it holds half a character, U+D800 to U+DFFF")
    return value


def path(value: typing.Any) -> str | os.PathLike[str]:
    """A file's or a folder's name."""
    if not isinstance(value, (str, os.PathLike)):
        raise Unfit
    return value


def data(value: typing.Any) -> str | bytes:
    """Text, or what holds bytes, such as an array of them."""
    if isinstance(value, str):
        return value
    try:
        view = memoryview(value)
    except TypeError:
        raise Unfit from None
    if view.itemsize != 1:
        raise Unfit
    return view.tobytes()


def pattern(value: typing.Any) -> re.Pattern[typing.Any]:
    """A regular expression."""
    if not isinstance(value, (str, bytes, re.Pattern)):
        raise Unfit
    try:
        return re.compile(value)
    except re.error as wrong:
        raise ValueError(str(wrong)) from None


def called(value: typing.Any) -> Function:
    """A function, or what can be called as one."""
    if not callable(value):
        raise Unfit
    return value


def texts(value: typing.Any) -> list[str]:
    """Several texts; one is none."""
    if isinstance(value, str) or not isinstance(value, collections.abc.Iterable):
        raise Unfit
    return [text(each) for each in value]


def by_name(value: typing.Any) -> dict[str, str]:
    """Texts by text."""
    if not isinstance(value, collections.abc.Mapping):
        raise Unfit
    return {text(key): text(each) for key, each in value.items()}


#: by annotation ("| None" besides): what makes a value fit or says that it is unfit, and what is expected
KINDS: dict[str, tuple[Function, str]] = {
    "int": (whole, "a whole number"),
    "float": (number, "a number"),
    "bool": (truth, "True or False"),
    "str": (text, "text"),
    "str | os.PathLike[str]": (path, "a file's name"),
    "str | bytes": (data, "text or bytes"),
    "Pattern": (pattern, "a regular expression"),
    "collections.abc.Callable[[World], object]": (called, "a function"),
    "str | collections.abc.Callable[[], object]": (lambda value: value if isinstance(value, str) else called(value),
                                                   "a condition in text or a function"),
    "collections.abc.Iterable[str]": (texts, "a list of texts"),
    "collections.abc.Mapping[str, str]": (by_name, "a dict of texts, by a robot's name"),
}


def fit(where: str, annotation: str, value: typing.Any) -> typing.Any:
    """The value as its annotation wants it. Raises TypeError, or ValueError where the kind is right."""
    make, expected = KINDS[annotation]
    try:
        return make(value)
    except Unfit:
        raise TypeError(f"{where}: got {value!r}, expected {expected}") from None
    except ValueError as wrong:
        raise ValueError(f"{where}: got {value!r}, expected {expected}: {wrong}") from None


def _checked(function: Function, where: str) -> Function:
    """The function behind a check of those of its arguments whose annotations are known."""
    checks = [(i, p.name, p.annotation.removesuffix(" | None"), p.annotation.endswith(" | None"), p.kind == p.KEYWORD_ONLY)
              for i, p in enumerate(inspect.signature(function).parameters.values())
              if isinstance(p.annotation, str) and p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY)
              and p.annotation.removesuffix(" | None") in KINDS]
    if not checks:
        return function

    @functools.wraps(function)
    def call(*arguments: typing.Any, **named: typing.Any) -> typing.Any:
        __tracebackhide__ = True
        given: list[typing.Any] = list(arguments)
        for i, name, annotation, may_be_none, is_named in checks:
            place, key = (given, i) if i < len(given) and not is_named else (named, name)
            if (place is given or key in named) and not (may_be_none and place[key] is None):
                place[key] = fit(f"{where}: {name}", annotation, place[key])
        return function(*given, **named)

    return call


def checked(kind: _Class) -> _Class:
    """A class whose public methods, and what is assigned to properties, are checked by their annotations."""
    for name, member in list(vars(kind).items()):
        if isinstance(member, property) and member.fset:
            setattr(kind, name, member.setter(_checked(member.fset, name)))
        elif inspect.isfunction(member) and (name == "__init__" or not name.startswith("_")):
            setattr(kind, name, _checked(member, kind.__name__ if name == "__init__" else name))
    return kind
