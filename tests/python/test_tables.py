# SPDX-License-Identifier: MIT
"""Tables of grades, and numbers and texts as files hold them, without a run."""
import csv
import tomllib
import xml.etree.ElementTree

import pytest

import twinpuck
from twinpuck import _grade
from twinpuck._grade import Case, Grade
from twinpuck._worldtext import toml_text, toml_value

#: outcomes of test_x, which gives 4 points: its share, its cell
SHARES = [
    (["passed"], 1, "pass"), (["failed"], 0, "FAIL"), (["skipped"], 0, "skip"), ([], 0, "FAIL"),
    (["passed", "failed"], 0.5, "50 %"), (["passed", "passed", "failed"], 2 / 3, "67 %"),
    (["passed", "skipped"], 1, "pass"), (["failed", "skipped"], 0, "FAIL"), (["passed", "failed", "skipped"], 0.5, "50 %"),
]


@pytest.mark.parametrize("outcomes, share, told", SHARES)
def test_a_test_over_several_runs_gives_its_share(outcomes, share, told):
    grade = Grade("a", [Case(f"t.py::test_x[seed={i}]", 4, outcome) for i, outcome in enumerate(outcomes)])
    assert grade.share("t.py::test_x") == pytest.approx(share) and grade.told("t.py::test_x") == told
    assert grade.points({"t.py::test_x": 4, "t.py::test_y": 3}) == pytest.approx(4 * share)


@pytest.mark.parametrize("name, base", [
    ("t.py::test_x", "t.py::test_x"), ("t.py::test_x[seed=1]", "t.py::test_x"), ("t.py::test_x[seed=1-hal=sim-selector=3]", "t.py::test_x"),
    ("t.py::test_x[far]", "t.py::test_x[far]"), ("t.py::test_x[far-seed=1]", "t.py::test_x[far]")])
def test_names_without_what_the_matrix_adds(name, base):
    assert _grade.base_name(name) == base


def class_of_four():
    """One passed, one in part with a text that XML cannot hold whole, one was not graded, one has fewer points for a test."""
    return [
        Grade("good", [Case("t.py::test_x", 4, "passed", seconds=0.25), Case("t.py::test_s", 2, "skipped"), Case("t.py::test_y", 1, "passed")]),
        Grade("part", [Case("t.py::test_x[seed=1]", 4, "passed"), Case("t.py::test_x[seed=2]", 4, "failed", "a < b\n\x01 more"),
                       Case("t.py::test_y", 1, "failed", "no\nlight")]),
        Grade("late", problem="got no end after 30 s, expected one (--limit)"),
        Grade("less", [Case("t.py::test_x", 3, "passed"), Case("t.py::test_y", 1, "skipped")]),
    ]


def test_the_table_of_the_terminal():
    assert [line.split() for line in _grade.text_table(class_of_four()).split("\n")] == [
        ["submission", "x", "s", "y", "of", "5"], ["good", "pass", "skip", "pass", "5"], ["part", "50", "%", "FAIL", "FAIL", "2"],
        ["late", "-", "-", "-", "0"], ["less", "pass", "FAIL", "skip", "4"],
        ["part:", "t.py::test_x:", "a", "<", "b"], ["part:", "t.py::test_y:", "no"],
        ["late:", "got", "no", "end", "after", "30", "s,", "expected", "one", "(--limit)"]]


def test_the_table_for_a_spreadsheet(tmp_path):
    _grade.write_csv(tmp_path / "g.csv", class_of_four())
    assert list(csv.reader(open(tmp_path / "g.csv", encoding="utf-8"))) == [
        ["submission", "t.py::test_x", "t.py::test_s", "t.py::test_y", "points", "of", "problem"],
        ["good", "4", "0", "1", "5", "5", ""], ["part", "2", "0", "0", "2", "5", ""],
        ["late", "0", "0", "0", "0", "5", "got no end after 30 s, expected one (--limit)"], ["less", "4", "0", "0", "4", "5", ""]]


def test_the_table_for_ci(tmp_path):
    _grade.write_junit(tmp_path / "g.xml", class_of_four())
    suites = list(xml.etree.ElementTree.parse(tmp_path / "g.xml").iter("testsuite"))
    assert [(s.get("name"), s.get("tests"), s.get("failures"), s.get("errors")) for s in suites] == [
        ("good", "3", "0", "0"), ("part", "3", "2", "0"), ("late", "0", "0", "1"), ("less", "2", "0", "0")]
    assert [[c.get("time") for c in s] for s in suites][0] == ["0.250", "0.000", "0.000"]
    assert [[child.tag for child in case] for case in suites[0]] == [[], ["skipped"], []]
    failure = suites[1][1][0]
    assert (failure.tag, failure.get("message"), failure.text) == ("failure", "a < b", "a < b\n? more")
    assert [(c.get("name"), c[0].tag, c[0].get("message")) for c in suites[2]] == [
        ("graded", "error", "got no end after 30 s, expected one (--limit)")]


def test_the_page(tmp_path):
    _grade.write_html(tmp_path / "g.html", class_of_four())
    page = (tmp_path / "g.html").read_text()
    assert page.count('class="good"') == 3 and page.count('class="bad"') == 7 and page.count("<details>") == 2
    assert "a &lt; b" in page and "<th scope=col>of 5</th>" in page and "<small>got no end after 30 s" in page


@pytest.mark.parametrize("words, wrong", [
    (["--limit", "0"], "command line: --limit: got 0, expected above 0 and below 1e6 s"),
    (["--limit", "1e6"], "command line: --limit: got 1e+06, expected above 0 and below 1e6 s"),
    (["--limit", "999999"], ""), (["--limit", "0.1"], ""),
    (["--jobs", "0"], "command line: --jobs: got 0, expected 1 to 256"), (["--jobs", "257"], "command line: --jobs: got 257, expected 1 to 256"),
    (["--jobs", "1"], ""), (["--jobs", "256"], "")])
def test_ranges_of_options(words, wrong, tmp_path):
    assert _grade.bad_input(_grade.parser().parse_args([str(tmp_path), "--submissions", str(tmp_path), "--trusted", *words])) == wrong


@pytest.mark.parametrize("value", ["", 'a "b" \\ c', "ä ✓ \U0001f600", "".join(map(chr, range(32))), "\x7f\x80\x9f", True, False, 0, -7, 10**18, 0.1,
                                   -1e-9, 1e300, [1, [2.5, "x"]], [], {"a b": {"ä": [1]}, "": 0}, (1, 2)])
def test_a_value_is_read_as_it_was(value):
    read = tomllib.loads("v = " + toml_value(value, "v"))["v"]
    assert read == (list(value) if isinstance(value, tuple) else value) and isinstance(read, bool) == isinstance(value, bool)


def test_sections_of_a_world_are_read_as_they_were():
    world = {"title": "a", "arena": {"size": [1, 2]}, "robot": [{"name": "a", "parts": {"x": 1}}, {"name": "b"}], "notes": [], "sizes": [1, 2]}
    assert tomllib.loads(toml_text(world)) == {"twinpuck": 1, **world}
    assert tomllib.loads(toml_text({"twinpuck": 2}))["twinpuck"] == 2


def test_a_recording_is_read_by_column(tmp_path):
    head = "time_s,robot,x_m,y_m,heading_rad,left_steps,right_steps,ir0,ir1,ir2,ir3,ir4,ir5,ir6,ir7,leds\n"
    (tmp_path / "r.csv").write_text(head + '0.01,"a, b",1.5,-2,0.25,7,-8,1,2,3,4,5,6,7,8,3ff\n0.02,c,0,0,0,0,0,,,,,,,,,0\n')
    rows = twinpuck.read_recording(tmp_path / "r.csv")
    assert rows[0].item() == (0.01, "a, b", 1.5, -2, 0.25, 7, -8, *range(1, 9), 0x3FF)
    assert rows[1].item() == (0.02, "c", 0, 0, 0, 0, 0, *[0] * 8, 0)  # of a robot without those sensors
