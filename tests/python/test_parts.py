# SPDX-License-Identifier: MIT
"""The parts of the contract (tests/contract/parts), with both HALs, as Python, the command, a test file and the view run
a program."""
import pathlib

import pytest
from conftest import TWINPUCK

import twinpuck
from twinpuck import live

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "contract/parts"
PARTS = sorted(file.stem for file in FOLDER.glob("*.c"))
LONGEST_S = 10


def lines_of(text):
    """{place: (name, value, tolerance)} of lines "name value [tolerance ...]"."""
    rows = [row.split() for row in text.splitlines() if row and row[0] != "#"]
    return [(r[0], int(r[1]), int(r[2]) if len(r) > 2 else 0) for r in rows if len(r) > 1 and r[1].lstrip("-").isdigit()]


def by_world(folder, hal, _):
    with twinpuck.World(folder / "world.toml", hal=hal) as world:
        world.robots[0].uart1.expect("end\n", at_most=LONGEST_S)
        return world.robots[0].uart1.text


def by_command(folder, hal, command):
    done = command("run", folder / "world.toml", "--hal", hal, "--for", LONGEST_S, "--uart", f"puck=file:{folder}/said", "-q")
    assert done.returncode == 0, done.stderr
    return (folder / "said").read_text()


def by_view(folder, hal, _):
    said = []
    with live.start("world.toml", "--hal", hal, command=TWINPUCK, cwd=folder, timeout=300) as page:
        page.ask("speed", factor="max")
        page.ask("play")
        # the other port's text may come in between
        page.event("serial", lambda e: e["port"] == 1 and (said.append(e["text"]) or "end\n" in "".join(said)))
    return "".join(said)


@pytest.mark.parametrize("run", [by_world, by_command, by_view])
@pytest.mark.parametrize("hal", ["sim", "dspic"])
@pytest.mark.parametrize("part", PARTS)
def test_a_part_says_what_is_expected(part, hal, run, tmp_path, command):
    (tmp_path / "part").mkdir()
    for file in (f"{part}.c", "say.h"):
        (tmp_path / "part" / file).write_text((FOLDER / file).read_text())
    (tmp_path / "world.toml").write_text(
        'twinpuck = 1\n[proximity]\nnoise_scale = 0\n[[wall]]\npoints = [[0.0775, -0.5], [0.0775, 0.5]]\n'
        '[[robot]]\nname = "puck"\nfirmware = "part"\nposition = [0, 0]\nselector = 5\n')
    said, expected = lines_of(run(tmp_path, hal, command)), lines_of((FOLDER / f"{part}.txt").read_text())
    assert [s[0] for s in said] == [e[0] for e in expected]
    for (name, value, _), (_, wanted, tolerance) in zip(said, expected):
        assert abs(value - wanted) <= tolerance, name
