# SPDX-License-Identifier: MIT
"""All that messages.txt says Python says, word for word; add what is new there."""
import os
import pathlib
import re

import numpy
import pytest

import twinpuck
from conftest import reads
from twinpuck import _declarative, _matrix, live


def of_a_row(text):
    """Text of a field."""
    return re.sub(r"\\(.)", lambda found: {"n": "\n", "t": "\t"}.get(found[1], found[1]), text)


def rows():
    """Names, and their steps: exception, call, text, files."""
    found = {}
    for line in (pathlib.Path(__file__).parent / "messages.txt").read_text().splitlines():
        if not line.startswith("#"):
            name, kind, call, says, *files = line.split("\t")
            steps = found.setdefault(name, []) if name else steps
            steps.append((kind, call, of_a_row(says), {f.split("=", 1)[0]: of_a_row(f.split("=", 1)[1]) for f in files}))
    return found.items()


def opened(more=None, **options):
    """A world of one robot "puck" that runs the folder's main.c; `more`: what else is in it."""
    return twinpuck.World({"arena": {"size": [1, 1]}, "robot": [{"name": "puck", "firmware": ".", "position": [0, 0]}], **(more or {})},
                          **options)


def play():
    """What a test file's run does."""
    file = _declarative.TestFile(pathlib.Path("a.test.toml"))
    with twinpuck.World(file.table["world"]) as world:
        _declarative.Run(file, world).run()


def values(axis, text):
    """What --seeds, --hal or --selector mean."""
    return {a.name: a for a in _matrix.AXES}[axis].values(text)


def marked(axis, arguments):
    """What @pytest.mark.seeds and so on mean."""
    return {a.name: a for a in _matrix.AXES}[axis].marked(arguments)


@pytest.mark.parametrize("name, steps", rows(), ids=[name for name, _ in rows()])
def test_are_said_word_for_word(name, steps, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    known = {"World": twinpuck.World, "twinpuck": twinpuck, "live": live, "numpy": numpy, "command": os.environ["TWINPUCK"],
             "opened": opened, "play": play, "values": values, "marked": marked}
    for kind, call, says, files in steps:
        for file, text in files.items():
            (tmp_path / file).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / file).write_text(text)
        if "main.c" in files and "opened" not in call and "play" not in call:
            known["world"] = opened()
            known["robot"] = known["world"].robots[0]
        with pytest.raises(Exception) as wrong:
            exec(call, known)
        assert type(wrong.value).__name__ == kind, f"{call}: {wrong.value!r}"
        # a KeyError's text is its argument in quotes
        reads(wrong.value.args[0] if kind == "KeyError" else str(wrong.value), says.replace("@/", f"{tmp_path}/"), call)
