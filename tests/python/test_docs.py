# SPDX-License-Identifier: MIT
"""What docs/testing.md shows runs: each example is a file, and passes."""
import pathlib
import re

import pytest

PAGE = (pathlib.Path(__file__).parents[2] / "docs" / "testing.md").read_text()
EXAMPLES = re.findall(r"\*\*(\d+)\. ([^*]+?)\.?\*\*.*?```python\n(.*?)```", PAGE, re.S)


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
