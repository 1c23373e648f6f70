# SPDX-License-Identifier: MIT
"""What README.md and docs/testing.md show runs: each example is a file, and passes."""
import pathlib
import re

import pytest

from twinpuck import _grade

ROOT = pathlib.Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "testing.md").read_text()
EXAMPLES = re.findall(r"\*\*(\d+)\. ([^*]+?)\.?\*\*.*?```python\n(.*?)```", PAGE, re.S)


def test_the_example_of_the_front_page_passes(tmp_path, command):
    page, folder = (ROOT / "README.md").read_text(), tmp_path / "stop"
    folder.mkdir()
    for language, file in (("c", "main.c"), ("python", "test_stop.py")):
        (folder / file).write_text(re.search(rf"```{language}\n(.*?)```", page, re.S).group(1))
    done = command("test", "-q", "stop", cwd=tmp_path)
    assert done.returncode == 0 and "1 passed" in done.stdout, done.stdout + done.stderr


def test_there_are_ten():
    assert [number for number, _, _ in EXAMPLES] == [str(n) for n in range(1, 11)]


@pytest.mark.parametrize("number", range(10))
def test_an_example_passes(number, tmp_path, command):
    (tmp_path / f"test_{number}.py").write_text(EXAMPLES[number][2])
    done = command("test", "-q", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"\d passed", done.stdout)


def test_the_test_file_passes(tmp_path, command):
    text = re.search(r"```toml\n(.*?)```", PAGE, re.S).group(1)
    (tmp_path / "a.test.toml").write_text(text)
    done = command("test", cwd=tmp_path)
    assert done.returncode == 0, done.stdout


def test_python_alone(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    exec(re.search(r"## In Python alone.*?```python\n(.*?)```", PAGE, re.S).group(1), {})
    assert (tmp_path / "maze.png").read_bytes()[:4] == b"\x89PNG"


def test_the_help_of_grade_has_every_option(tmp_path, command):
    said = command("grade", "--help", cwd=tmp_path).stdout
    options = [o for action in _grade.parser()._actions for o in action.option_strings if o.startswith("--")]
    assert len(options) > 10 and [o for o in options if f"  {o} " not in said and o != "--help"] == [], said
