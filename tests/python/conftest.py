# SPDX-License-Identifier: MIT
"""What the tests of the Python module share."""
import hashlib
import os
import pathlib
import re
import subprocess
import time

import pytest

import twinpuck


def pytest_make_parametrize_id(val):
    """Names of tests hold no sentences."""
    return re.sub(r"\W+", "_", val)[:24].strip("_") if isinstance(val, str) else None


TWINPUCK = os.environ["TWINPUCK"]
os.environ.pop("LD_PRELOAD", None)  # a sanitizer's; compilers have too little memory for it


def reads(said, wanted, what=""):
    """Fails unless it is said word for word, but for line ends behind it; each … is what has no space and varies."""
    said = said.rstrip("\n")
    assert re.fullmatch(re.escape(wanted).replace("…", r"\S+?"), said), f"{what}\ngot\n  {said!r}\nexpected\n  {wanted!r}"


def wait_until(condition, what):
    """Returns when condition() holds; fails, with `what` in the text, where it does not within 60 s."""
    until = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < until, what
        time.sleep(0.001)


@pytest.fixture(scope="session")
def programs(tmp_path_factory):
    """programs(source): a folder with that program in C, the same for the same source."""
    base = tmp_path_factory.mktemp("programs")

    def folder(source):
        place = base / hashlib.sha1(source.encode()).hexdigest()[:12]
        place.mkdir(exist_ok=True)
        (place / "main.c").write_text(source)
        return place

    return folder


@pytest.fixture
def opened(programs):
    """opened(source, **options): a world of one robot "puck" with that program, on an empty floor of 1 m by 1 m."""
    worlds = []

    def open_it(source, more=None, **options):
        world = twinpuck.World({"arena": {"size": [1, 1]}, "proximity": {"noise_scale": 0},
                                "robot": [{"name": "puck", "firmware": str(programs(source)), "position": [0, 0],
                                           **(more or {})}]}, **options)
        worlds.append(world)
        return world

    yield open_it
    for world in worlds:
        world.close()


@pytest.fixture
def command():
    """command(*words, cwd=, env=): runs `twinpuck WORDS`; a CompletedProcess with text."""
    def run(*words, cwd=None, env=None, timeout=900):
        return subprocess.run([TWINPUCK, *map(str, words)], cwd=cwd, env={**os.environ, **(env or {})}, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=timeout, check=False)

    return run


@pytest.fixture
def project(tmp_path):
    """project(**files): a folder with these files; __ stands for a dot in their names."""
    def make(**files):
        for name, text in files.items():
            file = tmp_path / name.replace("__", ".")
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
        return pathlib.Path(tmp_path)

    return make


IDLE = "int main(void) { while (1) ; }"
