# SPDX-License-Identifier: MIT
"""Runs the tests of this folder and tells of them as GoogleTest's programs do, for scripts/run_tests.py.

    run.py [--gtest_list_tests] [--gtest_filter=Suite.test:Suite.test] [FILES OR OPTIONS OF pytest]
"""
import pathlib
import re
import sys
import time

import pytest

HERE = pathlib.Path(__file__).resolve().parent


def name_of(item):
    """test_world.py::test_x[seed=1] as "world.x[seed=1]", in letters that a filter can have."""
    file, _, test = item.nodeid.partition("::")
    stem = pathlib.Path(file).stem.removeprefix("test_")
    name = re.sub(r"[^\w=.,@-]+", "_", test.removeprefix("test_"))
    return f"{stem}.{name[:100]}"


class Lines:
    """A pytest plug-in."""

    def __init__(self, wanted, only_list):
        self.wanted, self.only_list, self.began = wanted, only_list, {}

    def pytest_addoption(self, parser):
        parser.addoption("--verbose", type=int, default=0)  # the terminal's, which pytest asks for all the same

    @pytest.hookimpl(tryfirst=True)
    def pytest_collection_modifyitems(self, items):
        if self.wanted is not None:
            items[:] = [item for item in items if name_of(item) in self.wanted]
        if self.only_list:
            suite = ""
            for item in items:
                first, _, test = name_of(item).partition(".")
                if first != suite:
                    suite = first
                    print(f"{suite}.")
                print(f"  {test}")
            items.clear()

    def pytest_runtest_protocol(self, item):
        self.began[item.nodeid] = [name_of(item), time.monotonic(), "OK", ""]
        print(f"[ RUN      ] {name_of(item)}", flush=True)

    def pytest_runtest_logreport(self, report):
        entry = self.began[report.nodeid]
        if report.failed:
            entry[2], entry[3] = "FAILED", f"{report.longreprtext}\n{report.capstdout}{report.capstderr}"
            print(entry[3])
        elif report.skipped and entry[2] == "OK":
            entry[2] = "SKIPPED"
        if report.when == "teardown":
            name, began, outcome, _ = entry
            word = {"OK": "      OK", "FAILED": " FAILED ", "SKIPPED": " SKIPPED"}[outcome].strip().rjust(8)
            print(f"[ {word} ] {name} ({(time.monotonic() - began) * 1000:.0f} ms)", flush=True)

    def pytest_collectreport(self, report):
        if report.failed:
            print(f"{report.nodeid}: {report.longreprtext}")


def main():
    wanted, only_list, rest = None, False, []
    for argument in sys.argv[1:]:
        if argument.startswith("--gtest_filter="):
            wanted = set(argument.partition("=")[2].split(":"))
        elif argument == "--gtest_list_tests":
            only_list = True
        else:
            rest.append(argument)
    paths = [a for a in rest if not a.startswith("-")] or [str(HERE)]
    options = ["-p", "no:terminal", "-p", "no:cacheprovider", "-p", "twinpuck.pytest_plugin", "--rootdir", str(HERE)]
    code = pytest.main([*options, *(a for a in rest if a.startswith("-")), *paths],
                       plugins=[Lines(wanted, only_list)])
    sys.exit(0 if code in (0, 5) and (only_list or code == 0) else 1)


main()
