# SPDX-License-Identifier: MIT
"""What a failed test leaves: a folder of its own with a picture and a recording, and what is told of the run."""
from __future__ import annotations

import glob
import hashlib
import pathlib
import re
import shlex
import typing

from ._robot import Robot
from ._world import World

PICTURE, RECORDING = "picture.png", "run.inputs"
_LAST_LINES = 20
_MOST_DIAGNOSES = 10
_LONGEST = 200  # bytes of a folder's name; file systems have 255, and "~2" may follow
# a test whose name is its folder's, with "_" for its "::": that is the first "_" behind an ending
_PLAIN = re.compile(r"((?:(?!\.py_|\.toml_)[\w.\-])+\.(?:py|toml))::([\w.=\-\[\]]+)")


def name_of(nodeid: str, number: int = 0) -> str:
    """The folder of a test's failure, another one for each test; `number`: of its world."""
    name = re.sub(r"[^\w.=\-\[\]]+", "_", nodeid)
    whole = nodeid.encode("utf-8", "surrogateescape")
    if not _PLAIN.fullmatch(nodeid) or len(name.encode()) > _LONGEST:
        name = name.encode()[:_LONGEST].decode(errors="ignore") + "~" + hashlib.sha256(whole).hexdigest()[:12]
    return name if number == 0 else f"{name}~{number + 1}"


def clear(folder: pathlib.Path, nodeid: str) -> None:
    """Removes what an earlier failure of this test has left in `folder`, and nothing else."""
    name = name_of(nodeid)
    for recording in folder.glob(f"{glob.escape(name)}*/{RECORDING}"):
        if re.fullmatch(re.escape(name) + r"(~\d+)?", recording.parent.name) and not recording.parent.is_symlink():
            images = recording.with_name(f"{RECORDING}.images")
            for file in (recording, recording.with_name(PICTURE), *images.glob("*.elf")):
                file.unlink(missing_ok=True)
            if images.is_dir() and not any(images.iterdir()):
                images.rmdir()
            if not any(recording.parent.iterdir()):
                recording.parent.rmdir()


def show(world: World, folder: pathlib.Path) -> tuple[str, dict[str, typing.Any]]:
    """What is known of a run, as text; and the files that it leaves in `folder`, with the command that shows it again."""
    lines = [f"at {world.time_s:.3f} s, seed {world.seed}"]
    for robot in world.robots[:8]:
        lines += told(robot)
    if len(world.robots) > 8:
        lines.append(f"... and {len(world.robots) - 8} robots more")
    picture, recording = folder / PICTURE, folder / RECORDING
    try:
        folder.mkdir(parents=True, exist_ok=True)
        world.picture(picture)
        world.save_replay(recording)
    except (OSError, RuntimeError) as wrong:
        return "\n".join(lines + [f"no picture and no recording: {wrong}"]), {}
    again = f"twinpuck view --replay {shlex.quote(nearby(recording))}"
    lines += [f"picture: {nearby(picture)}", f"again:   {again}"]
    return "\n".join(lines), {"picture": picture, "recording": recording, "again": again}


def nearby(path: pathlib.Path) -> str:
    """As a person here would type it."""
    try:
        return str(path.relative_to(pathlib.Path.cwd()))
    except ValueError:
        return str(path)


def told(robot: Robot) -> list[str]:
    """A robot's state in a few lines: where it is, where its program stands and why, its last serial lines."""
    lines = [f"{robot.name}: at ({robot.x_m:.3f}, {robot.y_m:.3f}) m, {robot.heading_deg:.0f} deg, selector "
             f"{robot.selector}, battery {robot.battery_v:.2f} V"]
    if robot.hal:
        state = "stopped in" if robot.has_stopped else "stands in"
        lines.append(f"  its program ({robot.program}, hal {robot.hal}) {state} {robot.place}")
        lines += [f"  {line}" for line in robot.why().rstrip().splitlines()]
    lines += [f"  trap: {line}" for trap in robot.traps for line in str(trap).splitlines()]
    diagnoses = robot.diagnoses
    lines += [f"  {diagnosis}" for diagnosis in diagnoses[:_MOST_DIAGNOSES]]
    if len(diagnoses) > _MOST_DIAGNOSES:
        lines.append(f"  and {len(diagnoses) - _MOST_DIAGNOSES} more diagnoses")
    for port, serial in (("uart1", robot.uart1), ("uart2", robot.uart2)):
        if serial.lines:
            lines.append(f"  last lines of {port}:")
            lines += [f"    {line.encode('unicode_escape').decode()}" for line in serial.lines[-_LAST_LINES:]]
    return lines
