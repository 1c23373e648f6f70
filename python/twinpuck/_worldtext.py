# SPDX-License-Identifier: MIT
"""Worlds that are built in code: a dict with the keys of a world file (docs/worlds.md), as its text."""
from __future__ import annotations

import collections.abc
import json
import numbers
import re
import typing


def toml_key(key: str) -> str:
    """A key, or any text, in quotes."""
    return json.dumps(key, ensure_ascii=False).replace("\x7f", "\\u007f")


def toml_value(value: typing.Any, where: str) -> str:
    """One value as TOML writes it. Raises TypeError for what TOML has not."""
    if hasattr(value, "tolist"):  # NumPy's numbers and arrays; it need not be here
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, str):
        if re.search("[\ud800-\udfff]", value):
            raise TypeError(f"{where}: got {value!r}, expected text without halves of characters")
        return toml_key(value)
    if isinstance(value, collections.abc.Mapping):
        inner = (f"{toml_key(str(key))} = {toml_value(v, f'{where}.{key}')}" for key, v in value.items())
        return "{" + ", ".join(inner) + "}"
    if isinstance(value, collections.abc.Sequence) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(toml_value(v, f"{where}[{i}]") for i, v in enumerate(value)) + "]"
    raise TypeError(f"{where}: got {value!r}, expected a number, text, list or dict")


def toml_text(world: collections.abc.Mapping[str, typing.Any]) -> str:
    """The text of a world file: a dict for a section, a list of dicts for one that may be repeated ([[robot]])."""
    lines, tables = [], []
    for key, value in {"twinpuck": 1, **world}.items():
        if isinstance(value, collections.abc.Mapping):
            tables.append(f"[{key}]\n" + _table(value, key))
        elif isinstance(value, (list, tuple)) and any(isinstance(v, collections.abc.Mapping) for v in value):
            tables += [f"[[{key}]]\n" + _table(v, f"{key}[{i}]") for i, v in enumerate(value)]
        else:
            lines.append(f"{toml_key(key)} = {toml_value(value, key)}\n")
    return "".join(lines) + "\n" + "\n".join(tables)


def _table(table: collections.abc.Mapping[str, typing.Any], where: str) -> str:
    return "".join(f"{toml_key(str(k))} = {toml_value(v, f'{where}.{k}')}\n" for k, v in table.items())
