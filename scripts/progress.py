# SPDX-License-Identifier: MIT
"""Runs a command and shows that it lives: its counts at most every two seconds, and a word when it is silent."""
import re
import select
import subprocess
import sys
import time

SILENCE_S = 10.0  # a command that says nothing for so long gets a line
REFRESH_S = 2.0   # counts come no faster than this

COUNT = re.compile(r"^\[(\d+)/(\d+)\] (.*)")
ROOM = re.compile(r"(\S+?)/CMakeFiles/|(\S+)$")


def say(line):
    # in one piece: two may say something at once
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def brief(text):
    """What ninja makes, by its room: 'Building CXX object sim_core/CMakeFiles/...' -> 'sim_core'."""
    found = ROOM.search(text)
    return (found.group(1) or found.group(2)) if found else text


def read_lines(process, silence=SILENCE_S):
    """The lines of a process as they come; None whenever so many seconds have passed without one."""
    pending = b""
    while True:
        ready, _, _ = select.select([process.stdout], [], [], silence)
        if not ready:
            yield None
            continue
        chunk = process.stdout.read1(65536)
        if not chunk:
            break
        *lines, pending = (pending + chunk).split(b"\n")
        for line in lines:
            yield line.decode(errors="replace")
    if pending:
        yield pending.decode(errors="replace")


def ninja(build, targets, jobs, label=""):
    """Builds targets with counts; errors of the compiler come through whole. Returns ninja's exit status."""
    command = ["nice", "ninja", "-C", build, "-j", str(jobs)] + targets
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    started = shown = time.monotonic()
    count = ""
    told = False
    for line in read_lines(process):
        now = time.monotonic()
        match = COUNT.match(line) if line is not None else None
        if match and "globbed" in match.group(3):
            continue
        if match:
            count = f"[{match.group(1)}/{match.group(2)}]"
            if brief(match.group(3)) and (now - shown >= REFRESH_S or not told):
                say(f"{label}{count} {brief(match.group(3))}")
                shown, told = now, True
        elif line is None:
            say(f"{label}{count or 'configuring'} ... {now - started:.0f} s")
            shown = now
        elif line and not line.startswith(("ninja: Entering", "ninja: no work", "-- ")):
            say(line)
    return process.wait()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit("progress.py: got too few words, expected BUILD_FOLDER JOBS [TARGET...]")
    sys.exit(ninja(sys.argv[1], sys.argv[3:], sys.argv[2]))
