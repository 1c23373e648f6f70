# SPDX-License-Identifier: MIT
"""The pytest plug-in: fixtures for worlds and robots, runs over seeds, HALs and selectors, and what a failure shows.

    def test_lights_up(world):          # world.toml beside the test, a fresh one for each test
        world.run(1.0)
        assert world.robots[0].leds[0]

`twinpuck test` is pytest with this plug-in. docs/testing.md is the guide.
"""
from __future__ import annotations

import collections.abc
import difflib
import itertools
import os
import pathlib
import re
import traceback
import typing

import pytest

from . import _core, _declarative, _failures, _matrix, _outputs
from ._errors import InvalidRun, OutputLost, TwinpuckError
from ._kept_world import KeptWorld
from ._robot import Robot
from ._world import World, read, text_in

_WORLDS = pytest.StashKey[list[KeptWorld]]()
_LOST = pytest.StashKey[list[str]]()  # outputs, a line each


# --- options and markers

def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("twinpuck", "e-puck firmware on Twinpuck")
    # where the plug-in is found by itself, short names might be those of somebody's conftest.py
    prefix = "--" if os.environ.get("TWINPUCK_TEST") == "1" else "--twinpuck-"

    def add(name: str, **words: typing.Any) -> None:
        group.addoption(prefix + name, dest=f"twinpuck_{name}", **words)

    add("seeds", metavar="1..50", help="run each test of a world with these seeds: 1..50 or 1,2,7")
    add("hal", metavar="sim,dspic", help="... with programs linked with these HALs")
    add("selector", metavar="0..15", help="... with all robots' selectors in these positions")
    add("firmware", metavar="DIR", help="what the robots run instead of what the world says")
    add("sanitize", action="store_true", help="check each access of memory of programs built from source")
    add("coverage", metavar="FILE", help="lcov file that counts of the programs' lines are added to")
    add("failures", metavar="DIR", help="where failures leave picture and recording (.twinpuck/failures)")


def option(config: pytest.Config, name: str) -> typing.Any:
    """What the command line says: option(config, "seeds")."""
    return config.getoption(f"twinpuck_{name}")


_MARKERS = {
    "world": "world(source, **options): the world of the fixture `world`, as twinpuck.World",
    "robot": "robot(name): the robot of the fixture `robot`; else the world's first",
    "points": "points(n): what passing is worth in `twinpuck grade`; else 1",
    "seeds": "seeds(1..50): run with each of these seeds",
    "hals": "hals(sim, dspic): run with programs linked with each of these HALs",
    "selectors": "selectors(0..15): run with each of these positions of the selector",
}


def pytest_configure(config: pytest.Config) -> None:
    for line in _MARKERS.values():
        config.addinivalue_line("markers", line)
    config.stash[_LOST] = []
    if wrong := wrong_options(config):
        raise pytest.UsageError("\n".join(wrong))


def wrong_options(config: pytest.Config) -> list[str]:
    """What is wrong with the command line's options."""
    for axis in _matrix.AXES:
        try:
            axis.values(option(config, axis.option))
        except ValueError as wrong:
            return [f"command line: {wrong}"]
    firmware, coverage, failures = (option(config, name) for name in ("firmware", "coverage", "failures"))
    if firmware and not pathlib.Path(firmware).exists():
        return [f"{firmware}: --firmware: got nothing, expected a folder of C files, an image or a program of the PC"]
    if hasattr(config, "workerinput"):  # one process asks, not each of several
        return []
    junit = getattr(config.option, "xmlpath", None)
    problems = _outputs.conflicts([(coverage, "--coverage"), (junit, "--junitxml"), (failures, "--failures")])
    if junit and os.path.dirname(junit):  # pytest makes it
        problems += filter(None, [_outputs.wrong_folder(os.path.dirname(junit), "--junitxml")])
    if failures and os.path.exists(failures):
        problems += filter(None, [_outputs.wrong_folder(failures, "--failures")])
    return problems or _outputs.unwritable([(coverage, "--coverage"), (junit, "--junitxml")])


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """A test is about to run: what it left when it failed before goes. That of others stays, to be looked at."""
    try:
        _failures.clear(failures_folder(item.config), item.nodeid)
    except OSError as wrong:
        raise pytest.UsageError(f"{wrong.filename}: --failures: got {wrong.strerror!r}, expected a file that can be "
                                "removed") from None


def failures_folder(config: pytest.Config) -> pathlib.Path:
    """Where failures leave what they show."""
    return pathlib.Path(option(config, "failures") or config.rootpath / ".twinpuck" / "failures")


def wrong_marker(marker: pytest.Mark, known: set[str]) -> str:
    """What is wrong with a marker at a test; empty: nothing. known: those that somebody has registered."""
    if marker.name not in known:
        near = difflib.get_close_matches(marker.name, _MARKERS, 1, 0.75)
        return f"unknown marker '{marker.name}'; did you mean '{near[0]}'?" if near else ""
    arguments = [*marker.args, *marker.kwargs.values()]
    if marker.name == "world" and not marker.args and "source" not in marker.kwargs:
        return "world: got no source, expected a file, a name, a text or a dict"
    if marker.name == "robot" and not (len(arguments) == 1 and isinstance(arguments[0], (str, int))):
        return f"robot: got {arguments}, expected a name or a number"
    if marker.name == "points" and not (len(marker.args) == 1 == len(arguments) and _declarative.is_points(marker.args[0])):
        return f"points: got {', '.join(map(repr, arguments)) or 'none'}, expected a number from 0 to 1e6"
    for axis in (axis for axis in _matrix.AXES if axis.marker == marker.name):
        try:
            axis.marked(marker.args)
        except ValueError as wrong:
            return str(wrong).replace(f"--{axis.option}", axis.marker, 1)
    return ""


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    known = {re.split(r"[(:]", line)[0].strip() for line in metafunc.config.getini("markers")}
    for each in metafunc.definition.iter_markers():
        if wrong := wrong_marker(each, known):
            raise pytest.Collector.CollectError(f"{metafunc.definition.nodeid}: {wrong}")
    if not {"world", "make_world"} & set(metafunc.fixturenames):
        return
    for axis in _matrix.AXES:
        marker = metafunc.definition.get_closest_marker(axis.marker)
        values = axis.values(option(metafunc.config, axis.option)) or axis.marked(marker and marker.args)
        if values:
            metafunc.fixturenames.append(axis.fixture)
            metafunc.parametrize(axis.fixture, values, ids=[f"{axis.name}={v}" for v in values], indirect=True)


# --- fixtures

@pytest.fixture(name="_seed")
def _seed_of(request: pytest.FixtureRequest) -> int:
    return request.param


@pytest.fixture(name="_hal")
def _hal_of(request: pytest.FixtureRequest) -> str:
    return request.param


@pytest.fixture(name="_selector")
def _selector_of(request: pytest.FixtureRequest) -> int:
    return request.param


@pytest.fixture
def _chosen(request: pytest.FixtureRequest) -> dict[str, typing.Any]:
    """What the matrix says of this test: seed, hal, selector."""
    parameters = request.node.callspec.params if hasattr(request.node, "callspec") else {}
    return {axis.name: parameters[axis.fixture] for axis in _matrix.AXES if axis.fixture in parameters}


@pytest.fixture
def firmware(request: pytest.FixtureRequest) -> pathlib.Path | None:
    """The program under test: --firmware, else the test's own folder if it holds C files; else None."""
    given = option(request.config, "firmware")
    if given:
        return pathlib.Path(given).resolve()
    folder = request.path.parent
    return folder if any(folder.glob("*.c")) else None


@pytest.fixture
def make_world(request: pytest.FixtureRequest, _chosen: dict[str, typing.Any]) -> \
        collections.abc.Iterator[collections.abc.Callable[..., World]]:
    """Opens worlds: make_world(source, **options) as twinpuck.World, relative to the test's folder, with the seed, HAL
    and selector of this run of the test. They are closed when the test is over."""
    worlds = request.node.stash.setdefault(_WORLDS, [])

    def make(source: typing.Any = "world.toml", *arguments: typing.Any, **options: typing.Any) -> World:
        __tracebackhide__ = True
        world = open_world(request.config, request.path.parent, source, _chosen, *arguments, **options)
        worlds.append(world)
        return world

    yield make
    close(request.config, worlds)


def close(config: pytest.Config, worlds: list[KeptWorld]) -> None:
    """Closes a test's worlds. That coverage was lost is no test's failure: it is told at the end."""
    for world in worlds:
        try:
            world.drop()
        except OutputLost as wrong:
            config.stash[_LOST] += str(wrong).splitlines()


@pytest.fixture
def world(request: pytest.FixtureRequest, make_world: collections.abc.Callable[..., World]) -> World:
    """A fresh world: that of @pytest.mark.world(source, **options), else world.toml beside the test."""
    __tracebackhide__ = True
    marker = request.node.get_closest_marker("world")
    if marker:
        return make_world(*marker.args, **marker.kwargs)
    if not (request.path.parent / "world.toml").exists():
        pytest.fail(f"{request.path.parent}: got no world.toml, expected one beside the test, or "
                    "@pytest.mark.world(\"maze\", firmware=...) at it", pytrace=False)
    return make_world("world.toml")


@pytest.fixture
def robot(request: pytest.FixtureRequest, world: World) -> Robot:
    """A robot of the world: that of @pytest.mark.robot(name), else its first."""
    marker = request.node.get_closest_marker("robot")
    return world.robots[marker.args[0] if marker else 0]


def place_of(source: typing.Any, folder: pathlib.Path) -> typing.Any:
    """A world's source as it is meant in a test's folder."""
    source = text_in(source, folder)
    if isinstance(source, (str, os.PathLike)):
        return next((file for file in (folder / source, folder / f"{source}.toml") if file.is_file()), source)
    return source


def open_world(config: pytest.Config, folder: pathlib.Path, source: typing.Any, chosen: dict[str, typing.Any],
               firmware: typing.Any = None, **options: typing.Any) -> KeptWorld:
    """Opens a world for a test in `folder`, as the command line and the matrix (`chosen`) want it."""
    __tracebackhide__ = True
    source = place_of(source, folder)

    def here(program: typing.Any) -> typing.Any:
        return folder / program if isinstance(program, (str, os.PathLike)) and (folder / program).exists() else program

    def supervisor(given: str) -> str:
        name, equals, program = given.rpartition("=")
        return f"{name}{equals}{here(program)}"

    if option(config, "firmware"):
        firmware = pathlib.Path(option(config, "firmware")).resolve()
    elif isinstance(firmware, collections.abc.Mapping):
        firmware = {robot: here(program) for robot, program in firmware.items()}
    else:
        firmware = here(firmware)
    if "supervisors" in options:
        options["supervisors"] = [supervisor(given) for given in options["supervisors"]]
    for name in ("seed", "hal"):
        if name in chosen:
            options[name] = chosen[name]
    if option(config, "sanitize"):
        options["sanitize"] = True
    if option(config, "coverage"):
        options["coverage"] = str(pathlib.Path(option(config, "coverage")).resolve())
    world = KeptWorld(source, firmware, **options)
    if option(config, "coverage"):
        world.lost = config.stash[_LOST]
    if "selector" in chosen:
        for each in world.robots:
            each.selector = chosen["selector"]
    return world


# --- tests without a program

def pytest_collect_file(file_path: pathlib.Path, parent: pytest.Collector) -> pytest.Collector | None:
    if not file_path.name.endswith(".test.toml"):
        return None
    return DeclarativeFile.from_parent(parent, path=file_path)


def wrong_places(file: _declarative.TestFile, firmware: str | None) -> str:
    """What is wrong with the world and the program that a file names, of which `firmware` takes the place."""
    try:
        text, path, _ = read(place_of(file.table["world"], file.path.parent))
    except (TwinpuckError, OSError) as wrong:
        return f"{file.path}: test.world: {wrong}"
    problems = _core.check_world(text, path)
    if not firmware and "firmware" in file.table:
        wrong_name = _core.check_firmware(file.table["firmware"], str(file.path.parent))
        problems += f"{file.path}: test.firmware: {wrong_name}" if wrong_name else ""
    return problems


class DeclarativeFile(pytest.File):
    """A *.test.toml file: a test for each seed, HAL and selector."""

    def collect(self) -> collections.abc.Iterator[pytest.Item]:
        file = _declarative.TestFile(self.path)
        if wrong := wrong_places(file, option(self.config, "firmware")):
            raise _declarative.TestFileError(wrong)
        axes = [[(axis.name, value) for value in axis.values(option(self.config, axis.option)) or file.values(axis)]
                for axis in _matrix.AXES]
        for chosen in itertools.product(*(values for values in axes if values)):
            matrix = "-".join(f"{name}={value}" for name, value in chosen)
            yield DeclarativeTest.from_parent(self, name=file.title + (f"[{matrix}]" if matrix else ""), file=file,
                                              chosen=dict(chosen))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: typing.Any = None) -> typing.Any:
        return str(excinfo.value) if isinstance(excinfo.value, TwinpuckError) else super().repr_failure(excinfo)


class DeclarativeTest(pytest.Item):
    """One run of a *.test.toml file."""

    def __init__(self, *, file: _declarative.TestFile, chosen: dict[str, typing.Any], **more: typing.Any) -> None:
        super().__init__(**more)
        self.file, self._chosen = file, chosen
        self.add_marker(pytest.mark.points(file.table.get("points", 1)))

    def runtest(self) -> None:
        table = self.file.table
        world = open_world(self.config, self.path.parent, table["world"], self._chosen, table.get("firmware"))
        self.stash[_WORLDS] = [world]
        _declarative.Run(self.file, world).run()

    def teardown(self) -> None:
        close(self.config, self.stash.get(_WORLDS, []))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: typing.Any = None) -> typing.Any:
        return str(excinfo.value) if isinstance(excinfo.value, TwinpuckError) else super().repr_failure(excinfo)

    def reportinfo(self) -> tuple[pathlib.Path, int, str]:
        return self.path, 0, self.name


# --- what a failure shows

@pytest.hookimpl(trylast=True)
def pytest_runtest_call(item: pytest.Item) -> None:
    """Behind a test that passed: a run whose faults never took effect shows nothing, so it did not pass."""
    for world in item.stash.get(_WORLDS, []):
        world.as_it_came_to_be().check_faults()


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[None]) -> collections.abc.Iterator[None]:
    outcome = yield
    report: pytest.TestReport = outcome.get_result()
    if call.when != "call" or not report.failed:
        return
    if call.excinfo is not None and isinstance(call.excinfo.value, InvalidRun):
        item.user_properties.append(("twinpuck_invalid", str(call.excinfo.value)))
    if call.excinfo is not None and isinstance(call.excinfo.value, _declarative.TestFileError):
        item.user_properties.append(("twinpuck_bad_input", str(call.excinfo.value)))
    for number, world in enumerate(item.stash.get(_WORLDS, [])):
        properties: dict[str, typing.Any] = {}
        try:
            ended = world.as_it_came_to_be()
            properties = {"seed": ended.seed, "time_s": ended.time_s}
            shown, files = _failures.show(ended, failures_folder(item.config) / _failures.name_of(item.nodeid, number))
        except Exception as wrong:  # whatever it is: the failure itself must be told, and of the other tests theirs
            shown, files = f"nothing more can be shown: {wrong}", {}
        report.sections.append((f"world {pathlib.Path(world.file).name}", shown))
        # JUnit's readers take files that are named so, and text that stands beside them
        properties.update(files)
        item.add_report_section("call", "stdout", "\n".join(
            [shown] + [f"[[ATTACHMENT|{file}]]" for file in files.values() if isinstance(file, pathlib.Path)]) + "\n")
        item.user_properties += [(f"twinpuck_{key}", str(value)) for key, value in properties.items()]
    report.user_properties = list(item.user_properties)


# --- outputs that are lost

@pytest.hookimpl(hookwrapper=True, trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> collections.abc.Iterator[None]:
    outcome = yield
    lost = session.config.stash[_LOST]
    junit = getattr(session.config.option, "xmlpath", None)
    try:
        outcome.get_result()
    except OSError as wrong:  # of a full disk, which names no file: JUnit's, or pytest's own notes for --lf and --ff
        frames = traceback.extract_tb(wrong.__traceback__)
        is_cache = any(pathlib.Path(frame.filename).name == "cacheprovider.py" for frame in frames)
        if not junit and not is_cache:
            raise
        lost.append(_outputs.lost(".pytest_cache: cache_dir" if is_cache else f"{junit}: --junitxml", wrong))
        outcome.force_result(None)
    if hasattr(session.config, "workeroutput"):
        session.config.workeroutput["twinpuck_lost"] = lost
    elif lost:
        session.exitstatus = 7


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: typing.Any) -> None:
    """Of the processes of -n."""
    node.config.stash[_LOST] += getattr(node, "workeroutput", {}).get("twinpuck_lost", [])


def pytest_terminal_summary(terminalreporter: typing.Any, config: pytest.Config) -> None:
    for line in dict.fromkeys(config.stash[_LOST]):
        terminalreporter.write_line(line, red=True)
