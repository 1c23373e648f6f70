#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How many cases of tests/dspic30/instruction_cases.txt try each row of dspic30/core/instructions.csv, and which rows
are in doubt. Each case asserts result, flags, program counter and cycles of assembler text, computed by hand.

    scripts/instruction_coverage.py            print the table
    scripts/instruction_coverage.py --check    exit 1 when a row has no case
"""
import collections
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TABLE = ROOT / "dspic30/core/instructions.csv"
CASES = ROOT / "tests/dspic30/instruction_cases.txt"
DOUBT = re.compile(r"uncertain|doubt|undocumented|\[\?\]|undefined|documentation lists only|meaningless")


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    cases, row = collections.Counter(), None
    for line in CASES.read_text().split("\n"):
        if line.startswith("="):
            row = line[1:].strip()
        elif line and line[0] != "#":
            cases[row] += 1
    lines, total, without = [], 0, []
    with TABLE.open(newline="") as table:
        for r in csv.DictReader(table):
            mnemonic = r["mnemonic"]
            is_condition = mnemonic.startswith("BRA ")
            name = (mnemonic + ("," if is_condition else " ") + r["operands"]).strip().replace("BRA ,", "BRA ")
            count = cases.pop(name, 0)
            total += count
            if not count:
                without.append(name)
            lines.append("%-8s %-28s %2d  %s" % (mnemonic, r["operands"], count, r["notes"] if DOUBT.search(r["notes"]) else ""))
    for name in cases:
        print("instruction_cases.txt: no row of the table: %s" % name)
    for name in without:
        print("instructions.csv: no case in instruction_cases.txt: %s" % name)
    if sys.argv[1:] == []:
        print("\n".join(line.rstrip() for line in lines))
    print("instructions: %d rows, %d cases" % (len(lines), total))
    return 1 if cases or without else 0


if __name__ == "__main__":
    sys.exit(main())
