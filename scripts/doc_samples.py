#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds the samples of README.md and docs/*.md against what the program prints.

    scripts/doc_samples.py BUILD_FOLDER            writes the samples, and the pictures that they make, anew
    scripts/doc_samples.py BUILD_FOLDER --check    exit 1 when a sample differs

A sample is a block that begins with "$ twinpuck ..." or "$ build/twinpuck ...". It shows the output or a part of it, or
of a text file that the command writes. How long a run took on the PC is not compared. A file NAME.toml that the
command reads and the tree has not is the ```toml block above it.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"^```\w*\n\$ (?:build/)?twinpuck ([^\n]*)\n(.*?)^```$", re.M | re.S)
TOML = re.compile(r"^```toml\n(.*?)^```$", re.M | re.S)
WALL_TIME = re.compile(r"in [\d.]+ s \(\d+ times real time\)")
CHANGES = re.compile(r"[0-9a-f]{16}|-?\d+(?:\.\d+)?|no bound")  # what may differ in a sample that is out of date


def shape(line):
    """A line without its numbers: finds the place of a sample in newer output."""
    return re.sub(r"\s+", " ", CHANGES.sub("#", line)).strip()


def outputs(command, program, folder, toml):
    """What the command says and the text files that it writes, as lists of lines."""
    (folder / "docs/images").mkdir(parents=True)
    for name in ("worlds", "firmware", "bench"):
        os.symlink(ROOT / name, folder / name)
    for name in re.findall(r"(?<= )[\w.-]+\.toml", command):
        (folder / name).write_text(toml)
    said = subprocess.run(f"'{program}' {command}", shell=True, cwd=folder, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False).stdout.replace(f"{ROOT}/", "")
    written = [p for p in sorted(folder.iterdir()) if p.is_file() and p.suffix != ".toml"]
    return [text.splitlines() for text in [said] + [p.read_text(errors="replace") for p in written]]


def place(sample, lines, key):
    """The part of `lines` that equals the sample, seen through `key`; None if there is none."""
    wanted = [key(line) for line in sample]
    for at in range(len(lines) - len(sample) + 1):
        if [key(line) for line in lines[at:at + len(sample)]] == wanted:
            return lines[at:at + len(sample)]
    return None


def first_place(sample, texts, key):
    found = (place(sample, lines, key) for lines in texts)
    return next((lines for lines in found if lines is not None), None)


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    check = len(sys.argv) == 3
    program = pathlib.Path(sys.argv[1]).resolve() / "twinpuck"
    problems = 0

    for page in [ROOT / "README.md"] + sorted((ROOT / "docs").rglob("*.md")):
        text = page.read_text()
        for block in list(BLOCK.finditer(text)):
            command, sample = block.group(1), block.group(2).splitlines()
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                above = TOML.findall(text[:block.start()])
                texts = outputs(command, program, folder, above[-1] if above else "")
                if first_place(sample, texts, lambda line: WALL_TIME.sub("", line)) is None:
                    where = f"{page.relative_to(ROOT)}:{text.count(chr(10), 0, block.start(2)) + 1}"
                    new = first_place(sample, texts, shape)
                    if check or new is None:
                        problems += 1
                        print(f"{where}: sample of `twinpuck {command}`: differs from what it prints"
                              + ("; run scripts/doc_samples.py" if new else ", which is:"))
                        print("\n".join(new or texts[0]))
                    else:
                        old = block.group(0)
                        page.write_text(page.read_text().replace(
                            old, old.replace(block.group(2), "\n".join(new) + "\n")))
                        print(f"{where}: written anew")
                if not check:
                    for picture in (folder / "docs/images").iterdir():
                        shutil.copy(picture, ROOT / "docs/images" / picture.name)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
