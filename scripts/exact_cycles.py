#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The table of docs/time.md that holds what controllers' functions take on the chip.

    scripts/exact_cycles.py BUILD_FOLDER                    measures all controllers of firmware/, writes the table
    scripts/exact_cycles.py BUILD_FOLDER --check NAME...    exit 1 when one of these is not what the table says

A check lets a mean differ by a twentieth or 4 cycles: the compiler may find better code for other reasons.
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys

import generated

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGE = ROOT / "docs/time.md"
ROW = re.compile(r"^(\w+) +(\d+) +(\d+) +(\d+) +\S+ +\S+% +(\d+) +(\d+) +(\d+ to \d+|\d+|-)  ")
SHARE, LEAST = 0.05, 4  # of a check
NAME, MIN, MEAN, MAX, CALLS, OWN, CODE = range(7)


def measure(program, controller):
    """(controller, rows) of functions that were called in two seconds of the maze."""
    said = subprocess.run([program, "cycles", controller], cwd=ROOT, capture_output=True, text=True, check=False)
    if said.returncode:
        sys.exit(f"{controller}: {said.stderr}{said.stdout}")
    return controller, [match.groups() for match in map(ROW.match, said.stdout.splitlines()) if match]


def table(measured):
    lines = ["| controller | function | by its code | in the run: least, mean, most | calls |", "|---|---|---:|---:|---:|"]
    for controller, rows in measured:
        for r in rows:
            run = r[MEAN] if r[MIN] == r[MAX] else f"{r[MIN]}, {r[MEAN]}, {r[MAX]}"
            lines.append(f"| {controller} | `{r[NAME]}()` | {r[CODE]} | {run} | {r[CALLS]} |")
    return "\n".join(lines) + "\n"


def check(measured, text):
    wrong = 0
    for controller, rows in measured:
        for r in rows:
            row = re.search(rf"^\| {controller} \| `{r[NAME]}\(\)` \| [^|]+ \| (?:\d+, )?(\d+)", text, re.M)
            told = int(row[1]) if row else None
            if told is None or abs(told - int(r[MEAN])) > max(LEAST, SHARE * told):
                print(f"docs/time.md: {controller}, {r[NAME]}(): got {told} cycles, expected {r[MEAN]}; "
                      "run scripts/exact_cycles.py")
                wrong = 1
    return wrong


def main():
    if len(sys.argv) < 2 or (len(sys.argv) > 2 and sys.argv[2] != "--check"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    program = str(pathlib.Path(sys.argv[1]).resolve() / "twinpuck")
    names = sys.argv[3:] or sorted(p.parent.name for p in (ROOT / "firmware").glob("**/main.c"))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        measured = list(pool.map(lambda name: measure(program, name), names))
    page = PAGE.read_text()
    begin, end = generated.part(page, "cycles")
    if len(sys.argv) > 2:
        return check(measured, page[begin:end])
    PAGE.write_text(page[:begin] + table(measured) + page[end:])
    return 0


if __name__ == "__main__":
    sys.exit(main())
