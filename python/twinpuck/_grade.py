# SPDX-License-Identifier: MIT
"""`twinpuck grade`: tests over a class's folders, each in a process that sees no other's, and one table of points."""
from __future__ import annotations

import argparse
import collections.abc
import concurrent.futures
import contextlib
import csv
import dataclasses
import functools
import html
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import typing
import xml.etree.ElementTree as ElementTree

from . import _ending, _matrix, _outputs

_BUBBLEWRAP = "/usr/bin/bwrap"
_INTERRUPTED = "not graded to its end: interrupted"
_UNREAD = "the test cannot be read: "
_ENDINGS = {"--csv": ".csv", "--html": ".html", "--junitxml": ".xml"}
_CODES = ("Exit codes: 0 everybody was graded, 2 bad input, 6 somebody was not: the tests broke, 7 a table could not be "
          "written, 130 interrupted")


@dataclasses.dataclass
class Case:
    """A test's outcome for one submission. outcome: "passed", "failed", "skipped", "not run"; text: why, first line first; has_no_world:
    it failed because none could be opened."""

    name: str
    points: float
    outcome: str
    text: str = ""
    seconds: float = 0.0
    has_no_world: bool = False


@dataclasses.dataclass
class Grade:
    """What came of one submission. problem: it was not graded to its end, and why; is_broken: that is the tests' fault, or
    ours, so its points say nothing."""

    name: str
    cases: list[Case] = dataclasses.field(default_factory=list)
    problem: str = ""
    is_broken: bool = False

    def points(self, tests: collections.abc.Mapping[str, float]) -> float:
        """Points of all tests that passed; a test over several seeds gives its points in parts."""
        return sum(self.share(test) * points for test, points in tests.items())

    def share(self, test: str) -> float:
        """Of a test's runs over seeds, HALs and selectors, the part that passed."""
        runs = [case for case in self.cases if base_name(case.name) == test and case.outcome != "skipped"]
        return sum(case.outcome == "passed" for case in runs) / len(runs) if runs else 0.0

    def told(self, test: str) -> str:
        """Its cell in a table: "pass", "FAIL", "70 %"; "skip", where each of its runs was skipped; "-": it was not run."""
        outcomes = {case.outcome for case in self.cases if base_name(case.name) == test}
        if outcomes <= {"not run"} and self.problem:
            return "-"
        share = self.share(test)
        return "skip" if outcomes == {"skipped"} else "pass" if share == 1 else "FAIL" if share == 0 else f"{100 * share:.0f} %"

    def why(self, test: str) -> str:
        """The first line of why the first run of a test failed; empty: it did not, or `problem` says it."""
        line = next((case.text.split("\n")[0] for case in self.cases
                     if base_name(case.name) == test and case.outcome == "failed"), "")
        return line if line != self.problem else ""

    def told_by_all(self) -> str:
        """Why no test could open a world, as all tell it: the program cannot be built, mostly. Empty: some could."""
        ran = [case for case in self.cases if case.outcome != "skipped"]
        lines = {case.text.split("\n")[0] if case.has_no_world else "" for case in ran}
        return lines.pop() if len(lines) == 1 else ""


def base_name(name: str) -> str:
    """"test_a.py::test_x[seed=1]" without what the matrix adds."""
    head, bracket, tail = name.partition("[")
    if not bracket:
        return name
    rest = [part for part in tail.removesuffix("]").split("-") if part.partition("=")[0] not in
            {axis.name for axis in _matrix.AXES}]
    return head + (f"[{'-'.join(rest)}]" if rest else "")


# --- one submission, in a process of its own

def run_tests(arguments: list[str]) -> int:
    """In the child: pytest over the tests, what came of it as JSON. arguments: result's file, then pytest's."""
    import pytest

    cases: list[Case] = []
    points_of: dict[str, float] = {}  # of all tests that are to run, by name

    class Collector:
        def pytest_collection_finish(self, session: pytest.Session) -> None:
            for item in session.items:
                marker = item.get_closest_marker("points")
                points_of[item.nodeid] = float(marker.args[0]) if marker and marker.args else 1.0

        def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
            if report.when == "call" or report.outcome != "passed":
                cases.append(Case(report.nodeid, points_of[report.nodeid], report.outcome, reason(report), report.duration,
                                  said(report).startswith("twinpuck.WorldError: ")))
                write()  # a later test may have no end

        def pytest_collectreport(self, report: pytest.CollectReport) -> None:
            if report.failed:
                cases.append(Case(report.nodeid, 0, "failed", _UNREAD + report.longreprtext))

    def said(report: pytest.TestReport) -> str:
        crash = getattr(report.longrepr, "reprcrash", None)
        return crash.message if crash else report.longreprtext

    def reason(report: pytest.TestReport) -> str:
        first = re.sub(r"^twinpuck\.\w+: ", "", said(report))
        shown = [content for name, content in report.sections if name.startswith("world ")]
        return "\n".join([first, *shown]) if report.outcome == "failed" else ""

    def write() -> None:
        whole = pathlib.Path(arguments[0])
        half = whole.with_name(whole.name + ".half")
        begun = {case.name for case in cases}
        rest = [Case(name, points, "not run") for name, points in points_of.items() if name not in begun]
        half.write_text(json.dumps([dataclasses.asdict(case) for case in cases + rest]), encoding="utf-8")
        half.replace(whole)

    os.environ["TWINPUCK_TEST"] = "1"
    code = pytest.main(["-p", "twinpuck.pytest_plugin", "-p", "no:cacheprovider", "-q", "-q", *arguments[1:]],
                       plugins=[Collector()])
    write()
    return int(code)


def contained(words: list[str], options: argparse.Namespace, mine: pathlib.Path, work: pathlib.Path) -> list[str]:
    """`words` so that they see one submission alone, write to their own folder only and have no network.

    mine: the submission's folder.
    """
    from . import _core

    seen = [common(options.tests), pathlib.Path(_core.project_root()), pathlib.Path(_core.__file__).parents[1]]
    return [_BUBBLEWRAP, "--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc", "--tmpfs", "/tmp",
            *(word for path in seen for word in ("--ro-bind", str(path), str(path))),
            "--bind", str(work), str(work), "--tmpfs", str(options.submissions), "--ro-bind", str(mine), str(mine),
            "--unshare-all", "--die-with-parent", "--new-session", "--", *words]


_LOOKS_S = 0.05  # how long the end of what heeds signals may go unseen
_running: set[int] = set()  # groups of processes, one a submission that is being graded
_is_ending = threading.Event()  # no more of them


def wait_for(words: list[str], environment: collections.abc.Mapping[str, str], log: pathlib.Path,
             limit_s: float) -> int | None:
    """Runs tests in a group of processes of their own; pytest's exit code, None: they were ended after so long."""
    with open(log, "wb") as out:
        child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT, env=environment,
                                 start_new_session=True)
        _running.add(child.pid)
        try:
            if _is_ending.is_set():
                raise subprocess.TimeoutExpired(words, 0)
            return child.wait(limit_s)
        except subprocess.TimeoutExpired:
            return None
        finally:
            if child.returncode is None:
                os.killpg(child.pid, signal.SIGKILL)
                child.wait()
            _running.discard(child.pid)


def words_of(options: argparse.Namespace, result: pathlib.Path, mine: pathlib.Path) -> list[str]:
    """What runs the tests on a program, in a process of its own."""
    words = [sys.executable, "-m", "twinpuck._grade", "--run-tests", str(result), *map(str, options.tests), "--firmware",
             str(mine), "-c", os.devnull, "--rootdir", str(common(options.tests))]
    for name in ("seeds", "hal", "selector"):
        if getattr(options, name):
            words += [f"--{name}", getattr(options, name)]
    return words


def cases_of(result: pathlib.Path) -> list[Case]:
    """What run_tests() wrote."""
    try:
        return [Case(**case) for case in json.loads(result.read_text(encoding="utf-8"))]
    except (OSError, ValueError):
        return []


def unreadable(options: argparse.Namespace, mine: pathlib.Path, base: pathlib.Path) -> str:
    """What is wrong with the tests themselves, of which nobody could get a point; empty: nothing."""
    result, log = base / "tests.json", base / "tests.txt"
    environment = {**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    if not options.trusted:  # tests may make a world as they are read
        environment["TWINPUCK_SUBMISSION"] = str(mine.resolve())
    code = wait_for([*words_of(options, result, mine), "--collect-only"], environment, log, options.limit_s)
    tests = ", ".join(map(str, options.tests))
    if failed := [case for case in cases_of(result) if case.outcome == "failed"]:
        return "\n".join(f"{case.name}: {case.text}" for case in failed)
    if code == 5:
        return f"{tests}: tests: got none, expected one or more"
    if code is None:
        return f"{tests}: tests: got no end of reading them after {options.limit_s:g} s, expected one (--limit)"
    return log.read_text(encoding="utf-8", errors="replace").strip() if code else ""


def grade(student: pathlib.Path, options: argparse.Namespace, base: pathlib.Path) -> Grade:
    """Runs the tests on one submission, within its time."""
    result, mine, work = Grade(student.name), student / options.program, base / student.name
    if _is_ending.is_set():
        result.problem = _INTERRUPTED
        return result
    if not mine.is_dir():
        result.problem = f"got no folder {options.program!r}, expected the program there"
        return result
    if not options.trusted and not mine.resolve().is_relative_to(student.resolve()):
        result.problem = f"got a link to {mine.resolve()} for {options.program!r}, expected a folder of the submission"
        return result
    for folder in ("cache", "tmp", "failures"):
        (work / folder).mkdir(parents=True, exist_ok=True)
    words = [*words_of(options, work / "result.json", mine), "--failures", str(work / "failures")]
    if options.sanitize:
        words.append("--sanitize")
    if not options.trusted:
        words = contained(words, options, student, work)
    environment = {**os.environ, "XDG_CACHE_HOME": str(work / "cache"), "TMPDIR": str(work / "tmp"),
                   "TWINPUCK_CONTAIN": "0" if options.trusted else "1", "PYTHONDONTWRITEBYTECODE": "1"}
    if not options.trusted:
        environment["TWINPUCK_SUBMISSION"] = str(student.resolve())  # its builds read nothing else
        environment["PATH"] = "/usr/local/bin:/usr/bin:/bin"  # what they see
    log = work / "log.txt"
    code = wait_for(words, environment, log, options.limit_s)
    result.cases = cases_of(work / "result.json")
    if _is_ending.is_set() and (code is None or not result.cases):
        result.problem = _INTERRUPTED
    elif code is None:
        result.problem = f"got no end after {options.limit_s:g} s, expected one (--limit)"
    elif code not in _TOLD or not result.cases or any(case.outcome == "not run" for case in result.cases):
        result.problem, result.is_broken = broken(code, result.cases, log), True
    result.problem = result.problem or result.told_by_all()
    return result


_TOLD = (0, 1, 7)  # what pytest ends with when each test has an outcome


def broken(code: int, cases: list[Case], log: pathlib.Path) -> str:
    """Why tests came to no end of their own, as a line."""
    if unread := next((case for case in cases if case.text.startswith(_UNREAD)), None):
        return f"{unread.name}: " + " ".join(unread.text.split())
    said = [line for line in log.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
    errors = [line for line in said if re.match(r"INTERNALERROR> \S*(Error|Exception|Run|Fault|Lost)\b", line)]
    last = (errors or said)[-1:]
    return f"the tests broke (pytest's exit code {code})" + "".join(f": {line.removeprefix('INTERNALERROR> ')}" for line in last)


def common(paths: list[pathlib.Path]) -> pathlib.Path:
    """The folder that holds all of the tests."""
    folders = [path if path.is_dir() else path.parent for path in paths]
    return pathlib.Path(os.path.commonpath(folders))


# --- tables

def tests_of(grades: list[Grade]) -> dict[str, float]:
    """All tests that somebody's run had, with their points, in their order. What was skipped for all gives none."""
    tests: dict[str, float] = {}
    for grade_ in grades:
        for case in grade_.cases:
            name = base_name(case.name)
            tests[name] = max(tests.get(name, 0.0), case.points if case.outcome != "skipped" else 0.0)
    return tests


def text_table(grades: list[Grade]) -> str:
    """For the terminal: the table, then why somebody failed."""
    tests = tests_of(grades)
    short = [name.rpartition("::")[2].removeprefix("test_")[:18] for name in tests]
    width = max([len("submission"), *(len(g.name) for g in grades)])
    lines = ["  ".join([f"{'submission':{width}}", *short, f"of {sum(tests.values()):g}"])]
    for g in grades:
        cells = [f"{g.told(t) if not g.problem or g.cases else '-':{len(s)}}" for t, s in zip(tests, short)]
        lines.append("  ".join([f"{g.name:{width}}", *cells, f"{g.points(tests):g}"]))
    for g in grades:
        if g.problem:
            lines.append(f"{g.name}: {g.problem}")
        lines += [f"{g.name}: {test}: {g.why(test)}" for test in tests if g.why(test)]
    return "\n".join(lines)


def write_csv(path: str, grades: list[Grade]) -> None:
    """A row a submission: points of each test, all of them, why it was not graded."""
    tests = tests_of(grades)
    with open(path, "w", newline="", encoding="utf-8", errors="backslashreplace") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["submission", *tests, "points", "of", "problem"])
        for g in grades:
            table.writerow([g.name, *(f"{g.share(t) * p:g}" for t, p in tests.items()), f"{g.points(tests):g}",
                            f"{sum(tests.values()):g}", g.problem])


def write_html(path: str, grades: list[Grade]) -> None:
    """The table as a page; each failure opens to what was shown of it."""
    tests = tests_of(grades)
    rows = []
    for g in grades:
        cells = []
        for test in tests:
            texts = "\n\n".join(f"{case.name}\n{case.text}" for case in g.cases
                                if base_name(case.name) == test and case.outcome == "failed")
            told = g.told(test)
            look = {"pass": ' class="good"', "skip": ""}.get(told, ' class="bad"')
            cells.append(f"<td{look}>" +
                         (f"<details><summary>{told}</summary><pre>{html.escape(texts)}</pre></details>" if texts else told)
                         + "</td>")
        problem = f"<br><small>{html.escape(g.problem)}</small>" if g.problem else ""
        rows.append(f"<tr><th scope=row>{html.escape(g.name)}{problem}</th>{''.join(cells)}<td>{g.points(tests):g}</td></tr>")
    heads = "".join(f"<th scope=col>{html.escape(t.rpartition('::')[2])}<br>{p:g}</th>" for t, p in tests.items())
    text = f"""<!doctype html><html lang=en><meta charset=utf-8><title>Grades</title>
<style>body {{ font: 16px sans-serif; margin: 2em }} table {{ border-collapse: collapse }}
th, td {{ border: 1px solid #999; padding: .4em .7em; text-align: left; vertical-align: top }}
.good {{ background: #dff0d8; color: #1b4d13 }} .bad {{ background: #f8dcdc; color: #6b1414 }} pre {{ white-space: pre-wrap }}</style>
<h1>Grades</h1><table><tr><th scope=col>submission</th>{heads}<th scope=col>of {sum(tests.values()):g}</th></tr>
{chr(10).join(rows)}</table></html>
"""
    pathlib.Path(path).write_text(text, encoding="utf-8", errors="backslashreplace")


def write_junit(path: str, grades: list[Grade]) -> None:
    """A suite a submission, a case a run of a test."""
    root = ElementTree.Element("testsuites")
    for g in grades:
        failures = sum(case.outcome == "failed" for case in g.cases)
        suite = ElementTree.SubElement(root, "testsuite", name=printable(g.name), tests=str(len(g.cases)),
                                       failures=str(failures), errors="1" if g.problem else "0")
        for case in g.cases:
            element = ElementTree.SubElement(suite, "testcase", classname=printable(g.name), name=printable(case.name),
                                            time=f"{case.seconds:.3f}")
            if case.outcome == "failed":
                failure = ElementTree.SubElement(element, "failure", message=printable(case.text.split("\n")[0]))
                failure.text = printable(case.text)
            elif case.outcome != "passed":
                ElementTree.SubElement(element, "skipped", {"message": "not run"} if case.outcome == "not run" else {})
        if g.problem:
            element = ElementTree.SubElement(suite, "testcase", classname=printable(g.name), name="graded")
            ElementTree.SubElement(element, "error", message=printable(g.problem))
    ElementTree.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def printable(text: str) -> str:
    """Without what XML cannot hold."""
    return "".join(c if c in "\t\n" or c >= " " and not "\ud800" <= c <= "\udfff" and c not in "\ufffe\uffff" else "?"
                   for c in text)


# --- the command

class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> typing.NoReturn:
        """argparse's words as those of the other verbs."""
        for pattern, words in (
                (r"the following arguments are required: (.*)", r"\1: missing, expected as in `twinpuck grade --help`"),
                (r"unrecognized arguments: (\S+).*", r"unknown word: got '\1', expected an option of `twinpuck grade`"),
                (r"argument (\S+): invalid (?:int|float) value: (.*)", r"\1: got \2, expected a number"),
                (r"argument (\S+): expected .*", r"\1: got no value, expected one")):
            message = re.sub(pattern, words, message)
        self.exit(2, f"command line: {message}\nTry `twinpuck grade --help`.\n")


def parser() -> argparse.ArgumentParser:
    """The command's options."""
    p = _Parser(prog="twinpuck grade", epilog=_CODES, description="Runs tests over a class's folders: "
                                "each folder's program takes the place of the program under test.")
    p.add_argument("tests", nargs="+", type=pathlib.Path, help="folders or files of tests, as `twinpuck test` has them")
    p.add_argument("--submissions", required=True, type=pathlib.Path, metavar="DIR", help="a folder for each student in it")
    p.add_argument("--program", default="", metavar="NAME", help="the folder in each submission that holds the program")
    p.add_argument("--seeds", metavar="1..50", help="run each test with these seeds, which students need not know")
    p.add_argument("--hal", metavar="sim,dspic")
    p.add_argument("--selector", metavar="0..15")
    p.add_argument("--sanitize", action="store_true", help="check each access of memory of the programs")
    p.add_argument("--limit", dest="limit_s", type=float, default=120, metavar="S", help="real seconds a submission (120)")
    p.add_argument("--jobs", type=int, default=os.cpu_count() or 1, metavar="N", help="so many at a time (all cores)")
    p.add_argument("--csv", metavar="FILE", help="the points for a spreadsheet")
    p.add_argument("--html", metavar="FILE", help="the table as a page, with what failed")
    p.add_argument("--junitxml", metavar="FILE", help="for CI: a suite a submission")
    p.add_argument("--keep", type=pathlib.Path, metavar="DIR", help="keep pictures and recordings of failures here")
    p.add_argument("--trusted", action="store_true", help="programs of the PC are not contained")
    return p


def bad_input(options: argparse.Namespace) -> str:
    """What is wrong with the call; empty: nothing."""
    for axis in _matrix.AXES:
        try:
            axis.values(getattr(options, axis.option))
        except ValueError as wrong:
            return f"command line: {wrong}"
    for path in options.tests:
        if not path.exists():
            return f"{path}: tests: got nothing, expected a folder or file of tests"
    if not options.submissions.is_dir():
        return f"{options.submissions}: --submissions: got no folder, expected one with a folder for each student"
    if not 0 < options.limit_s < 1e6:
        return f"command line: --limit: got {options.limit_s:g}, expected above 0 and below 1e6 s"
    if not 1 <= options.jobs <= 256:
        return f"command line: --jobs: got {options.jobs}, expected 1 to 256"
    if not options.trusted and not os.access(_BUBBLEWRAP, os.X_OK):
        return f"{_BUBBLEWRAP}: got no bubblewrap, expected it to contain programs with; apt install bubblewrap, or trust them: --trusted"
    files = [(options.csv, "--csv"), (options.html, "--html"), (options.junitxml, "--junitxml")]
    # a table that was left beside the tests the last time may be written again
    others = [(path, option) for path, option in files if path and not path.endswith(_ENDINGS[option])]
    if wrong := _outputs.conflicts([*files, (options.keep, "--keep")], [options.submissions]) or \
            _outputs.conflicts([*others, (options.keep, "--keep")], options.tests) or _outputs.unwritable(files):
        return "\n".join(wrong)
    return _outputs.wrong_folder(options.keep, "--keep") if options.keep else ""


def main(arguments: list[str]) -> int:
    """The command."""
    if arguments[:1] == ["--run-tests"]:
        return run_tests(arguments[1:])
    options = parser().parse_args([a for a in arguments if a != "--"])
    if wrong := bad_input(options):
        print(wrong, file=sys.stderr)
        return 2
    options.tests = [path.resolve() for path in options.tests]
    options.submissions = options.submissions.resolve()
    students = sorted(path for path in options.submissions.iterdir() if path.is_dir() and not path.name.startswith("."))
    if not students:
        print(f"{options.submissions}: --submissions: got an empty folder, expected a folder for each "
              "student", file=sys.stderr)
        return 2
    programs = [student / options.program for student in students if (student / options.program).is_dir()]
    if not programs:
        print(f"{options.submissions}: --program: got no folder {options.program!r} in any submission, expected the "
              "program there", file=sys.stderr)
        return 2
    signal.pthread_sigmask(signal.SIG_BLOCK, _ending.SIGNALS)  # they are taken where nothing is half done
    # beside /tmp, of which those who are contained have their own
    base = pathlib.Path(tempfile.mkdtemp(prefix="twinpuck-grade-", dir="/var/tmp"))
    try:
        wrong = heeding_signals(lambda: unreadable(options, programs[0], base))
        if _is_ending.is_set():
            return _ending.INTERRUPTED
        if wrong:
            print(wrong, file=sys.stderr)
            return 2
        grades = heeding_signals(lambda: grade_all(students, options, base))
        _ending.heed_work()
        signal.pthread_sigmask(signal.SIG_UNBLOCK, _ending.SIGNALS)  # nobody may read what is written
        code = write_all(grades, options, base) or (6 if any(g.is_broken for g in grades) else 0)
        return _ending.INTERRUPTED if _is_ending.is_set() else code
    except KeyboardInterrupt:
        return _ending.INTERRUPTED
    finally:
        _ending.has_ended()
        signal.pthread_sigmask(signal.SIG_BLOCK, _ending.SIGNALS)  # who asks again waits for this
        shutil.rmtree(base, ignore_errors=True)


def write_all(grades: list[Grade], options: argparse.Namespace, base: pathlib.Path) -> int:
    """Each output by itself: one that is lost takes no other with it. The exit code."""
    def show() -> None:
        if sys.stdout:
            sys.stdout.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]
        print(text_table(grades), flush=True)

    def keep(name: str) -> None:
        left = base / name / "failures"
        if left.is_dir() and any(left.iterdir()):
            shutil.copytree(left, options.keep / name, dirs_exist_ok=True)

    writes: list[tuple[str, collections.abc.Callable[[], None]]] = [("standard output", show)]
    writes += [(path, functools.partial(write, path, grades)) for path, write in
               ((options.csv, write_csv), (options.html, write_html), (options.junitxml, write_junit)) if path]
    if options.keep:
        writes += [(str(options.keep / g.name), functools.partial(keep, g.name)) for g in grades]
    code = 0
    for name, write in writes:
        try:
            write()
        except OSError as wrong:
            print(_outputs.lost(name, wrong), file=sys.stderr)
            code = 7
            if write is show:  # what is left of it is not tried again at the end
                os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return code


def grade_all(students: list[pathlib.Path], options: argparse.Namespace, base: pathlib.Path) -> list[Grade]:
    """All of them, so many at a time, in their order. Who interrupts has those that were graded by then."""
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        return list(pool.map(lambda student: grade(student, options, base), students))


_Made = typing.TypeVar("_Made")


def heeding_signals(work: collections.abc.Callable[[], _Made]) -> _Made:
    """What `work` returns, which runs in a thread of its own. This one waits for the signals, which are held back: an
    exception could come between a process's begin and the place that knows of it. By one, nobody stays behind."""
    with concurrent.futures.ThreadPoolExecutor(1) as beside:
        made = beside.submit(work)
        while not made.done():
            if signal.sigtimedwait(_ending.heeded(), _LOOKS_S):
                _is_ending.set()
                for group in list(_running):
                    with contextlib.suppress(ProcessLookupError):  # it has just ended
                        os.killpg(group, signal.SIGKILL)
        return made.result()


if __name__ == "__main__":
    _ending.run(main)
