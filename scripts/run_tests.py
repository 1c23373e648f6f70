#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds and runs the test programs of a build folder, one line a test, and ends with "N passed, N failed".

    scripts/run_tests.py BUILD_FOLDER JOBS [--filter PART_OF_A_NAME] [--programs A,B,...]

While one program runs, the next ones are built, so the first results come early; when all are built, two run beside
each other. The filter selects programs or single
tests; a program that runs a list of tests, as firmware_register_test does, runs those of its list that match.
A test that runs for longer than TWINPUCK_TEST_LIMIT seconds (900) is ended, first what it has started. How long each
took stands in BUILD_FOLDER/tests/times.txt, milliseconds and name, the slowest first.
Exit code: 0 all passed, 1 some failed or did not build, 5 nothing selected.
"""
import argparse
import os
import queue
import re
import signal
import subprocess
import sys
import threading
import time

from progress import SILENCE_S, ninja, read_lines, say

RESULT = re.compile(r"^\[\s+(OK|FAILED|SKIPPED)\s+\] ([^ ,]+).*\((\d+) ms\)$")
SOURCE = re.compile(r"(?<![\w./-])(\.\./\S+?)(?=:\d+:)")  # as the compiler was told it, from the build folder
BEGIN = re.compile(r"^\[ RUN      \] (.*)")


def listed(program):
    """The tests of a program, as 'Suite.test'."""
    output = subprocess.run([program, "--gtest_list_tests"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                            text=True, check=False).stdout
    names, suite = [], ""
    for line in output.splitlines():
        word = line.split("#")[0].strip()
        if line.startswith("  "):
            names.append(suite + word)
        elif word.endswith("."):
            suite = word
    return names


def started_by(pid):
    """The processes that a process has started and that still run, those they have started first."""
    found = []
    for folder in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{folder}/stat", encoding="utf-8", errors="replace") as file:
                parent = int(file.read().rsplit(")", 1)[1].split()[1])
        except OSError:
            continue  # over by now
        if parent == pid:
            found += started_by(int(folder)) + [int(folder)]
    return found


def end_what_hangs(pid):
    """Ends what a test has started, so that the test can tell and the next ones run; itself where that is nothing."""
    for one in started_by(pid) or [pid]:
        try:
            os.kill(one, signal.SIGKILL)
        except ProcessLookupError:
            pass


LIMIT_S = float(os.environ.get("TWINPUCK_TEST_LIMIT", 900))  # some 30 times what the slowest takes on a free machine
times = []  # milliseconds and name of each test
failures = []  # names of those that failed, said once more at the end: a long log's last lines are what one sees


def run(build, name, tests):
    """Runs the given tests of a program, all of them if `tests` is None. Returns how many passed and failed."""
    command = [f"{build}/tests/{name}"] + ([] if tests is None else ["--gtest_filter=" + ":".join(tests)])
    # libasan 12 takes a library's thread-local block at the second 16 bytes of a page for one of an old glibc and
    # crashes in its search for leaks, one run in 256; unwatched, such blocks are found as what threads point to
    environment = dict(os.environ, GTEST_COLOR="no", XDG_CACHE_HOME=os.path.abspath(f"{build}/cache"),
                       ASAN_OPTIONS="intercept_tls_get_addr=0",
                       LSAN_OPTIONS=f"suppressions={os.getcwd()}/scripts/lsan.supp:print_suppressions=0")
    # what ends a test's programs ends them, though the run itself is one of nohup or in the background
    command = ["env", "--default-signal=HUP,INT,QUIT", *command]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=environment)
    passed = failed = 0
    current, said, since, hangs = "", [], time.monotonic(), False
    for line in read_lines(process, min(SILENCE_S, LIMIT_S)):
        if current and time.monotonic() - since > LIMIT_S:
            say(f"...   {name}: {current} is ended, it has run for more than {LIMIT_S:.0f} s")
            end_what_hangs(process.pid)
            hangs = True
            since = time.monotonic()  # what is left of it has the same time to end
        elif line is None:
            say(f"...   {name}: {current}, {time.monotonic() - since:.0f} s")
        if line is None:
            continue
        begin, result = BEGIN.match(line), RESULT.match(line)
        if begin:
            current, said, since, hangs = begin.group(1), [], time.monotonic(), False
        elif result and current:
            times.append((int(result.group(3)), f"{name}: {current}"))
            if result.group(1) == "FAILED" or hangs:
                failed += 1
                failures.append(f"{name}: {current}")
                say("\n".join([f"FAIL  {name}: {current}"] + ["      " + s for s in said]))
            else:
                passed += result.group(1) == "OK"
                say(f"{'ok  ' if result.group(1) == 'OK' else 'skip'}  {name}: {current}")
            current, said = "", []
        else:
            said.append(SOURCE.sub(lambda m: os.path.relpath(os.path.join(build, m.group(1))), line))
    status = process.wait()
    if status != 0 and not failed:
        failed = 1
        failures.append(f"{name}: ended with status {status}" + (f" in {current}" if current else ""))
        say("\n".join([f"FAIL  {name}: ended with status {status}" + (f" in {current}" if current else "")] +
                      ["      " + s for s in said[-200:]]))
    return passed, failed


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("jobs", type=int)
    parser.add_argument("--filter", default="")
    parser.add_argument("--programs", default="")
    options = parser.parse_args()
    with open(f"{options.build}/tests/programs.txt", encoding="utf-8") as file:
        programs = [line.split() for line in file.read().split("\n") if line]  # its name, the target to build, "asked"
    wanted = options.programs.split(",")
    programs = [p[:2] for p in programs if (p[0] in wanted if options.programs else "asked" not in p)]

    built = queue.Queue()

    def build_all():
        # a filter may fit a test of any program: mostly there is nothing to build, and one look tells
        if options.filter and ninja(options.build, [p[1] for p in programs], options.jobs, "      ") == 0:
            for name, _ in programs:
                built.put((name, 0))
            built.put(None)
            return
        for name, target in programs:
            built.put((name, ninja(options.build, [target], options.jobs, "      ")))
        built.put(None)

    counts = []  # passed and failed, of each program

    def run_built():
        while (item := built.get()) is not None:
            name, status = item
            if status != 0:
                counts.append((0, 1))
                failures.append(f"{name}: does not build")
                say(f"FAIL  {name}: does not build")
                continue
            tests = None
            if options.filter and options.filter not in name:
                tests = [t for t in listed(f"{options.build}/tests/{name}") if options.filter in t]
                if not tests:
                    continue
            counts.append(run(options.build, name, tests))
        built.put(None)  # for the other one

    building = threading.Thread(target=build_all, daemon=True)
    building.start()
    first = threading.Thread(target=run_built, daemon=True)
    first.start()
    building.join()
    if options.jobs > 1:
        run_built()
    first.join()
    with open(f"{options.build}/tests/times.txt", "w", encoding="utf-8") as file:
        file.writelines(f"{time} {test}\n" for time, test in sorted(times, reverse=True))
    passed, failed = (sum(column) for column in zip(*counts)) if counts else (0, 0)
    if passed + failed == 0:
        print(f"make test: T: got '{options.filter}', expected a part of a test's or a program's name", file=sys.stderr)
        return 5
    for failure in failures:
        say(f"failed: {failure}")
    say(f"{passed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
