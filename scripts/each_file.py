#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Looks at sources of the product one by one, in a build folder that is configured without unity builds.

    scripts/each_file.py BUILD alone    compiles every file by itself, syntax only: does it include what it uses?
    scripts/each_file.py BUILD tidy     clang-tidy (.clang-tidy) on what changed since main, or in the last commit; what is
                                        not begun after five minutes is left out, and said

Prints what compiler or clang-tidy say. Exit code: 0 nothing, 1 something.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LONGEST_TIDY_S = 300
# code of the robot's and of other people's programs, and tests, which are compiled file by file anyway
OTHERS = ("tests/", "bench/", "firmware/", "programs/controller/", "programs/supervisors/", "build")


def output(*command, cwd=ROOT):
    return subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False).stdout


def commands(build):
    """By source, from the top: the words that compile it, and where."""
    all_of_them = {}
    for entry in json.loads((ROOT / build / "compile_commands.json").read_text()):
        source = os.path.relpath(entry["file"], ROOT)
        if not source.startswith(OTHERS) and not source.startswith(".."):
            all_of_them.setdefault(source, (shlex.split(entry["command"]), entry["directory"]))
    return all_of_them


def make_generated(build):
    """What sources include and the build writes."""
    lines = output("ninja", "-C", build, "-t", "targets", "rule", "CUSTOM_COMMAND").split("\n")
    made = [line for line in lines if line.endswith((".inc", ".h"))]
    subprocess.run(["ninja", "-C", build, "--quiet", *made], cwd=ROOT, check=True)


def compiled_alone(command, directory):
    words = iter(command[1:] if command[0].endswith("ccache") else command)
    kept = [word for word in words if word != "-c" and not (word == "-o" and next(words))]
    return subprocess.run([*kept, "-fsyntax-only"], cwd=directory, capture_output=True, text=True, check=False)


def changed():
    """Names since where this branch left main; on main itself those of the last commit; with what is not committed."""
    head = output("git", "rev-parse", "HEAD").strip()
    for main in ("origin/main", "main"):
        base = output("git", "merge-base", "HEAD", main).strip()
        if base and base != head:
            break
    else:
        base = "HEAD~1"
    names = output("git", "diff", "--name-only", base) + output("git", "ls-files", "--others", "--exclude-standard")
    return set(names.split("\n"))


def tidied(build, source):
    run = subprocess.run(["clang-tidy", "-p", build, "--quiet", source], cwd=ROOT, capture_output=True, text=True, check=False)
    run.stderr = run.stdout  # stderr counts what was left out
    return run


def main():
    if len(sys.argv) != 3 or sys.argv[2] not in ("alone", "tidy"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    build, what = sys.argv[1:]
    subprocess.run(["ninja", "-C", build, "--quiet", "build.ninja"], cwd=ROOT, check=True)  # files that are new
    sources = commands(build)
    if what == "tidy":
        names = changed()
        stems = {name.rsplit(".", 1)[0] for name in names}  # a header is read with its source
        sources = {s: c for s, c in sources.items() if s in names or s.rsplit(".", 1)[0] in stems}
    if sources:
        make_generated(build)
    look = (lambda s: compiled_alone(*sources[s])) if what == "alone" else (lambda s: tidied(build, s))
    bad = left_out = 0
    give_up = time.monotonic() + (LONGEST_TIDY_S if what == "tidy" else float("inf"))

    def in_time(source):
        return look(source) if time.monotonic() < give_up else None

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for source, run in zip(sources, pool.map(in_time, sources)):
            if run is None:
                left_out += 1
            elif run.returncode != 0 or run.stderr.strip():
                bad += 1
                print(f"{source}:\n{run.stderr.strip()}", flush=True)
    print(f"{what}: {len(sources)} files, {bad} with something to say" + (f", {left_out} left out" if left_out else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
