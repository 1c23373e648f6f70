# SPDX-License-Identifier: MIT
"""A world with its robots."""
from __future__ import annotations

import collections.abc
import difflib
import json
import math
import numbers
import os
import pathlib
import re
import tempfile
import types
import typing
import weakref

from . import _arguments, _core, _outputs
from ._arguments import checked
from ._errors import FirmwareFault, InvalidRun, OutputLost, WorldError
from ._faults import Fault
from ._records import Recording
from ._robot import LineState, Robot, Trap
from ._worldtext import toml_key, toml_text, toml_value

if typing.TYPE_CHECKING:
    import numpy

_Thing = typing.TypeVar("_Thing")
Source = typing.Union[str, "os.PathLike[str]", "collections.abc.Mapping[str, typing.Any]"]
Firmware = typing.Union[None, str, "os.PathLike[str]", "collections.abc.Mapping[str, str | os.PathLike[str]]"]


_OPTIONS = {"fw": "firmware", "uart": "uart1"}  # of World, by the command's


def _program(value: typing.Any) -> Firmware:
    if isinstance(value, collections.abc.Mapping):
        return {_arguments.text(robot): _arguments.path(program) for robot, program in value.items()}
    return value if value is None else _arguments.path(value)


def _robot_or_name(value: typing.Any) -> Robot | str:
    if not isinstance(value, (Robot, str)):
        raise _arguments.Unfit
    return value


_arguments.KINDS.update({
    "world": (_arguments.path, "a file, the name of a world, text or a dict"),
    "Firmware": (_program, "a folder, a file, the name of a controller, or a dict of these"),
    "Robot | str": (_robot_or_name, "a robot or its name"),
})


class Robots(collections.abc.Sequence):
    """The robots of a world, in its order: by name or number, to go through, to count."""

    __slots__ = ("_world",)

    def __init__(self, world: World) -> None:
        self._world = world

    @property
    def names(self) -> list[str]:
        """Their names, in order."""
        return list(self._world._names)

    @typing.overload
    def __getitem__(self, key: int | str) -> Robot: ...
    @typing.overload
    def __getitem__(self, key: slice) -> list[Robot]: ...
    def __getitem__(self, key: int | str | slice) -> Robot | list[Robot]:
        """robots["left"], robots[0], robots[1:]. Raises KeyError or IndexError."""
        if isinstance(key, int) and not -len(self) <= key < len(self):
            raise IndexError(f"robot: got {key}, " + (f"expected {-len(self)} to {len(self) - 1}" if self else "the world has none"))
        if isinstance(key, str):
            if key not in self._world._by_name:
                raise KeyError(_no_such("robot", key, self._world._by_name))
            return self._world._robot(self._world._by_name[key])
        found = range(len(self))[key]
        return self._world._robot(found) if isinstance(found, int) else [self._world._robot(index) for index in found]

    def __len__(self) -> int:
        return len(self._world._names)

    def __contains__(self, name: object) -> bool:
        if isinstance(name, Robot):
            return name.world is self._world
        return name in self._world._by_name

    def __repr__(self) -> str:
        return f"<{len(self)} robots: {', '.join(self.names[:10])}{' ...' if len(self) > 10 else ''}>"


def _no_such(kind: str, name: str, there: collections.abc.Iterable[str]) -> str:
    names, near = list(there), difflib.get_close_matches(name, there, 1)
    return f"{kind}: got {name!r}, " + (f"expected one of {', '.join(names[:10])}" if names else "the world has none") + \
        (f"; did you mean {near[0]!r}?" if near else "")


class _Things(dict[str, _Thing]):
    """By name; of one that is not there, KeyError says which are."""

    def __init__(self, kind: str, things: dict[str, _Thing]) -> None:
        super().__init__(things)
        self._kind = kind

    def __missing__(self, name: str) -> _Thing:
        raise KeyError(_no_such(self._kind, name, self))


@checked
class Body:
    """A movable thing of the world: a box, a cylinder, a ball."""

    __slots__ = ("_world", "_index", "name")

    def __init__(self, world: World, index: int, name: str) -> None:
        self._world, self._index, self.name = world, index, name

    @property
    def pose(self) -> tuple[float, float, float]:
        """x, y (m), heading (degrees)."""
        x_m, y_m, heading_rad = self._world._core.body_pose(self._index)
        return x_m, y_m, math.degrees(heading_rad)

    def move(self, x_m: float, y_m: float, heading_deg: float = 0.0) -> None:
        """Puts it somewhere else, at rest."""
        self._world._apply({"do": "move", "body": self._index, "x": float(x_m), "y": float(y_m),
                            "heading": math.radians(heading_deg)})

    def __repr__(self) -> str:
        return f"<Body {self.name!r} at ({self.pose[0]:.3f}, {self.pose[1]:.3f}) m>"


@checked
class Lamp:
    """A lamp of the world."""

    __slots__ = ("_world", "_index", "name")

    def __init__(self, world: World, index: int, name: str) -> None:
        self._world, self._index, self.name = world, index, name

    def switch(self, on: bool, intensity_w_m2: float | None = None) -> None:
        """On or off; with another intensity (W/m2 where its attenuation is 1), else that of the world's file."""
        more = {} if intensity_w_m2 is None else {"intensity": float(intensity_w_m2)}
        self._world._apply({"do": "lamp", "lamp": self._index, "on": bool(on), **more})


@checked
class Condition:
    """A condition over named signals (`twinpuck list signals`): "abs(x_m) < 0.3 && led0", "left.x_m > right.x_m",
    "$state == 3" for a variable of the program. Called, it says whether it holds now; value is the number behind it."""

    __slots__ = ("_world", "text", "_robot", "_bound_to", "_watch")

    def __init__(self, world: World, text: str, robot: Robot | None) -> None:
        self._world, self.text, self._robot = world, text, robot
        self._bound_to: typing.Any = None
        self._bind()

    def _bind(self) -> typing.Any:
        if self._bound_to is not self._world._core:
            try:
                self._watch = _core.Watch(self._world._core, self.text, -1 if self._robot is None else self._robot.index)
            except ValueError as wrong:
                raise WorldError(f"condition {self.text!r}: {wrong}") from None
            self._bound_to = self._world._core
        return self._watch

    def __call__(self) -> bool:
        return self._bind().holds()

    @property
    def value(self) -> float:
        """What the text computes to now: of "x_m - 0.1" the number, of "x_m > 0.1" 1 or 0."""
        return self._bind().value

    def __repr__(self) -> str:
        return f"<Condition {self.text!r}>"


@checked
class World:
    """A world with its robots and their programs, at its time 0 when it is opened.

    source: a world file, the name of one of Twinpuck's worlds, the text of a world file, or a dict with the same keys:
        World({"arena": {"size": [1, 1]}, "robot": [{"name": "puck", "firmware": "blink", "position": [0, 0]}]})
    firmware: what robots run instead of what the file says: a folder of C files, an .elf, a .hex or the name of one of
        Twinpuck's controllers; of all robots, or a dict by robot
    seed: of all that is left to chance, instead of the file's
    hal: "sim" (fast) or "dspic" (every driver as it is flashed), for programs that are built from source
    optimise: "-O0", "-O1", "-O2", "-Os" for these; without it that of a project's file, else -O1
    sanitize: programs are checked at each access of memory; what they do wrong is a trap
    measured: names of robots whose functions are measured (profile(), cost_of()), ["*"] all; they run slower
    coverage: an lcov file to which the lines that programs execute are added when the world is closed
    threads: how many run firmware, 1 or more; nothing depends on it
    uart1, uart2: other ends of serial lines as `twinpuck run --uart` has them, by robot ("*": all)
    supervisors: programs as `twinpuck run --supervisor`
    traps: "raise": run() and all that runs raise FirmwareFault when a program traps; "report": they do not

    Raises WorldError when anything is wrong with the file, a program or an option; OSError when a file cannot be read.
    A world is closed by close(), by `with`, or when nothing refers to it or a robot of it any more.
    """

    __slots__ = ("_text", "_file", "_is_of", "_options", "_traps", "_callables", "_core", "_arrays", "_lines", "_robots", "_names",
                 "_by_name", "__weakref__")

    def __init__(self, source: Source, firmware: Firmware = None, *, seed: int | None = None, hal: str = "",
                 optimise: str = "", sanitize: bool = False, measured: collections.abc.Iterable[str] = (),
                 coverage: str | os.PathLike[str] = "", threads: int = 1,
                 uart1: collections.abc.Mapping[str, str] | None = None,
                 uart2: collections.abc.Mapping[str, str] | None = None,
                 supervisors: collections.abc.Iterable[str] = (), traps: str = "raise") -> None:
        self.traps = traps
        if hal not in ("", "sim", "dspic"):
            raise WorldError(f"World: hal: got {hal!r}, expected 'sim' or 'dspic'")
        if optimise not in ("", "-O0", "-O1", "-O2", "-Os"):
            raise WorldError(f"World: optimise: got {optimise!r}, expected '-O0', '-O1', '-O2' or '-Os'")
        if threads < 1 or threads > 256:
            raise WorldError(f"World: threads: got {threads}, expected 1 to 256")
        _check_seed(seed)
        if wrong := _outputs.unwritable([(coverage, "World: coverage")]):
            raise WorldError(wrong[0])
        __tracebackhide__ = True
        self._text, self._file, self._is_of = read(source)
        self._options: dict[str, typing.Any] = {
            "seed": seed, "hal": hal, "optimise": optimise, "sanitize": sanitize, "measured": list(measured),
            "coverage": os.fspath(coverage), "threads": threads, "supervisors": list(supervisors),
            "uart1": _by_robot(uart1 or {}), "uart2": _by_robot(uart2 or {}),
            "firmware": _choices(firmware, pathlib.Path(self._file).parent)}
        self._callables: list[collections.abc.Callable[[World], object]] = []
        self._core: typing.Any = None
        self._lines: dict[tuple[int, int], LineState] = {}  # by robot and UART
        self._robots: dict[int, weakref.ref[Robot]] = {}  # while somebody uses them
        self._open()
        self._names: list[str] = self._core.names
        self._by_name = {name: i for i, name in enumerate(self._names)}

    def _open(self) -> None:
        __tracebackhide__ = True
        try:
            self._core = _core.World(self._text, self._file, self._options)
        except ValueError as wrong:  # nobody has given options of a command line
            said = re.sub(r"^command line: --(\w+)", lambda m: "World: " + _OPTIONS.get(m[1], m[1]), str(wrong), flags=re.M)
            if self._is_of != "file":  # nobody finds one, nor a dict's lines
                place = r":\d+:\d+" if self._is_of == "dict" else ""
                said = re.sub(rf"^{re.escape(self._file)}{place}(?=:)", "World: source", said, flags=re.M)
            raise WorldError(said) from None
        self._arrays = _core.Arrays(len(self._core.names))

    @property
    def traps(self) -> str:
        """"raise" or "report", as it was opened with; it can be set."""
        return self._traps

    @traps.setter
    def traps(self, traps: str) -> None:
        if traps not in ("raise", "report"):
            raise WorldError(f"World: traps: got {traps!r}, expected 'raise' or 'report'")
        self._traps = traps

    @property
    def robots(self) -> Robots:
        """Its robots."""
        return Robots(self)

    def _robot(self, index: int) -> Robot:
        known = self._robots.get(index)
        robot = known and known()
        if robot is None:
            robot = Robot(self, index, self._names[index])
            self._robots[index] = weakref.ref(robot)
        return robot

    def _mine(self, where: str, robot: Robot | None) -> Robot | None:
        if robot is not None and robot.world is not self:
            raise ValueError(f"{where}: robot: got {robot!r} of another world, expected one of this one")
        return robot

    def _apply(self, what: dict[str, typing.Any]) -> None:
        for key, value in what.items():
            if isinstance(value, float) and not math.isfinite(value):
                raise ValueError(f"{what['do']}: {key}: got {value}, expected a finite number")
        try:
            self._core.apply(json.dumps(what))
        except ValueError as wrong:
            raise ValueError(f"{what['do']}: {wrong}") from None

    # --- time
    @property
    def time_s(self) -> float:
        """Simulated time (s)."""
        return self._core.now / _core.CLICKS_PER_SECOND

    @property
    def tick_s(self) -> float:
        """The world's tick (s): 1/512 unless its file says otherwise. Everything is asked and touched between ticks."""
        return self._core.tick_s

    def run(self, seconds: float) -> None:
        """Runs for so many simulated seconds, up to the end of a tick.

        Raises FirmwareFault when a program traps (unless traps is "report"). Ctrl-C ends it at a tick. Other Python
        threads run meanwhile, if no callable is called each tick.
        """
        __tracebackhide__ = True
        self._run(seconds, None)

    def run_until(self, condition: str | collections.abc.Callable[[], object], at_most: float) -> bool:
        """Runs until condition() is true, which is asked now and after each tick; False: not within `at_most` seconds.

        A text is a condition over signals: run_until("distance_m > 0.5", at_most=10). Raises as run() does, and
        whatever the condition raises.
        """
        __tracebackhide__ = True
        if isinstance(condition, str):
            condition = self.condition(condition)
        return bool(condition()) or self._run(at_most, condition)

    def step(self, ticks: int = 1) -> None:
        """Runs for so many ticks."""
        __tracebackhide__ = True
        most = int(1e8 / self.tick_s)
        if not 0 <= ticks <= most:
            raise ValueError(f"step: ticks: got {ticks}, expected 0 to {most}")
        for _ in range(ticks):
            self._run(self.tick_s / 2, None)

    def _run(self, seconds: float, condition: collections.abc.Callable[[], object] | None) -> bool:
        __tracebackhide__ = True
        if not 0 <= seconds <= 1e8:
            raise ValueError(f"run: got {seconds} s, expected 0 to 1e8")
        each_tick = condition
        if self._callables:
            def each_tick() -> bool:
                for call in list(self._callables):
                    call(self)
                return condition is not None and bool(condition())
        core = self._core
        begun = core.now
        end = begun + round(seconds * _core.CLICKS_PER_SECOND)
        why = core.run(end, each_tick, self.traps == "raise")
        if why == "trap":
            raise FirmwareFault(self._first_trap(begun / _core.CLICKS_PER_SECOND))
        return why == "asked"

    def _first_trap(self, from_s: float) -> Trap:
        """The first one since then: others may have come of it. One that comes again has its first time."""
        traps = sorted((trap for robot in self.robots for trap in robot.traps), key=lambda trap: trap.time_s)
        return next((trap for trap in traps if trap.time_s >= from_s), traps[-1])

    def on_tick(self, call: collections.abc.Callable[[World], object]) -> collections.abc.Callable[[World], object]:
        """`call(world)` is called after each tick from now on; it may look and touch, not run. Works as a decorator."""
        self._callables.append(call)
        return call

    def off_tick(self, call: collections.abc.Callable[[World], object]) -> None:
        """`call` is called no more. Raises ValueError when it was not."""
        if call not in self._callables:
            raise ValueError(f"off_tick: got {call!r}, expected what on_tick() was given")
        self._callables.remove(call)

    def reset(self, seed: int | None = None) -> None:
        """Begins anew at time 0, as if it had just been opened: programs are built if their sources changed.

        seed: another one than before. Robots of this world stay valid; callables of on_tick() stay. Raises WorldError
        when it cannot be opened; then it is closed, until another reset().
        """
        if seed is not None:
            _check_seed(seed)
            self._options["seed"] = seed
        self.close()
        self._open()
        self._lines.clear()

    def close(self) -> None:
        """Ends programs of the PC and writes coverage; raises OutputLost. What is asked or run later raises RuntimeError."""
        if problems := self._core.close():
            raise OutputLost(problems)

    def __enter__(self) -> World:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None,
                 trace: types.TracebackType | None) -> None:
        self.close()

    # --- signals
    def condition(self, text: str, robot: Robot | str | None = None) -> Condition:
        """A condition over signals, to be called. robot: whose a name is that stands without a robot's; in a world of
        one robot it need not be said. Raises WorldError, with a guess for names that are near."""
        return Condition(self, text, self.robots[robot] if isinstance(robot, str) else self._mine("condition", robot))

    def signal(self, name: str) -> float:
        """A signal now, in its unit: "time_s", "puck.x_m", "puck.$speed"."""
        return self.condition(name).value

    # --- faults
    def inject(self, kind: str, robot: Robot | str | None = None, *, at_s: float | None = None, when: str | None = None,
               for_s: float | None = None, **values: typing.Any) -> Fault:
        """A fault: inject("sensor_blocked", "puck", sensor=0, at_s=2, for_s=1.5), inject("bump", when="x_m > 0.2").

        It begins now, at a time (s) or when a condition over signals holds, for robot `robot` (None: for each), and ends
        `for_s` later, or never. `twinpuck list faults` names kinds and their values. Raises ValueError.
        """
        mine = self._mine("inject", robot) if isinstance(robot, Robot) else None
        table = {"kind": kind, "robot": mine.name if mine else robot, "at_s": at_s, "when": when,
                 "for_s": for_s, **values}
        text = "".join(f"{toml_key(key)} = {toml_value(v, f'inject: {key}')}\n" for key, v in table.items() if v is not None)
        return self._add_faults("[[fault]]\n" + text)[0]

    def load_faults(self, file: str | os.PathLike[str]) -> list[Fault]:
        """Faults and stimuli of a file (docs/testing.md). Raises OSError, or ValueError with all that is wrong."""
        return self._add_faults(pathlib.Path(file).read_text(encoding="utf-8"), os.fspath(file))

    def _add_faults(self, text: str, where: str = "") -> list[Fault]:
        """where: the file that the text is of, for messages; empty: none, so its lines are nobody's."""
        try:
            return [Fault(self, number) for number in self._core.add_faults(text, where)]
        except ValueError as wrong:
            raise ValueError(str(wrong) if where else re.sub(r"^:\d+:\d+: ", "inject: ", str(wrong), flags=re.M)) from None

    @property
    def faults(self) -> list[Fault]:
        """All that were asked for in this run."""
        return [Fault(self, number) for number in range(len(self._core.faults()))]

    def check_faults(self) -> None:
        """Raises InvalidRun when a fault never began, or never changed anything for a program or the world."""
        __tracebackhide__ = True
        if problems := self._core.fault_problems():
            raise InvalidRun("\n".join(re.sub(r"^:\d+:\d+: ", "inject: ", problem) for problem in problems))

    # --- all robots at once
    @property
    def poses(self) -> numpy.ndarray:
        """x (m), y (m) and heading (rad) of all robots: an array of robots times 3, brought up to now. No copy: the next
        look changes the same numbers; copy() keeps them. Read-only."""
        self._core.refresh(self._arrays, True, False, False)
        return self._arrays.poses

    @property
    def proximity(self) -> numpy.ndarray:
        """What e_get_prox() would give (counts), robots times 8, as poses is."""
        self._core.refresh(self._arrays, False, True, False)
        return self._arrays.proximity

    @property
    def leds(self) -> numpy.ndarray:
        """1 for each LED that is lit, robots times 10 (0 to 7 the ring, 8 body, 9 front), as poses is."""
        self._core.refresh(self._arrays, False, False, True)
        return self._arrays.leds

    @property
    def steps(self) -> numpy.ndarray:
        """Motor steps of the left and right wheels, robots times 2, as poses is."""
        self._core.refresh(self._arrays, False, False, True)
        return self._arrays.steps

    @property
    def batteries_v(self) -> numpy.ndarray:
        """Volts of all batteries, as poses is."""
        self._core.refresh(self._arrays, False, False, True)
        return self._arrays.battery_v

    # --- its things
    @property
    def bodies(self) -> dict[str, Body]:
        """Movable things by name, in the file's order; a name that several have is that of the last."""
        names = self._core.bodies
        return _Things("body", {names[i]: Body(self, i, names[i]) for i in range(len(self.robots), len(names))})

    @property
    def lamps(self) -> dict[str, Lamp]:
        """Lamps by name; one without a name is "lamp 0", by its number."""
        return _Things("lamp", {name or f"lamp {i}": Lamp(self, i, name) for i, name in enumerate(self._core.lamps)})

    @property
    def seed(self) -> int:
        """Of all that is left to chance."""
        return self._core.seed

    @property
    def file(self) -> str:
        """The world's file; where relative names begin."""
        return self._file

    @property
    def digest(self) -> str:
        """Hash of the course so far: equal for equal runs (16 hexadecimal digits)."""
        return f"{self._core.digest:016x}"

    @property
    def notices(self) -> list[str]:
        """What the compiler had to say about the programs, a line each."""
        return self._core.notices

    @property
    def ended(self) -> str | None:
        """How a supervisor ended the run: its words; None: it goes on."""
        has_ended, _, _, text = self._core.outcome
        return text if has_ended else None

    @property
    def supervisor_lines(self) -> list[str]:
        """Lines that supervisors have written."""
        return self._core.console(-1)

    # --- to keep
    def record(self, every_s: float = 0.01) -> Recording:
        """Rows of all robots from now on, at multiples of every_s (s), up to reset() or the world's end."""
        if not 1e-4 <= every_s <= 1e6:
            raise ValueError(f"record: every_s: got {every_s}, expected 0.0001 to 1e6 s")
        return Recording(self._core.record(float(every_s)), self.robots.names)

    def picture(self, file: str | os.PathLike[str] | None = None, *, rays: bool = False, width_px: int = 1200) -> bytes:
        """The world from above with the robots' ways, as a PNG; also written to `file`, a .png or .svg, if given.

        rays: with those of the proximity sensors. Raises RuntimeError when the file cannot be written.
        """
        if not 16 <= width_px <= 16384:
            raise ValueError(f"picture: width_px: got {width_px}, expected 16 to 16384")
        caption = f"{self.time_s:g} s, seed {self.seed}, {len(self.robots)} robot{'' if len(self.robots) == 1 else 's'}"
        if file is not None:
            self._core.draw(os.fspath(file), caption, rays, width_px)
            return pathlib.Path(file).read_bytes()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture.png")
            self._core.draw(path, caption, rays, width_px)
            return pathlib.Path(path).read_bytes()

    def _repr_png_(self) -> bytes:
        return self.picture(width_px=600)  # of notebooks

    def save_replay(self, file: str | os.PathLike[str]) -> None:
        """Writes how the world was opened and every touch with its tick: `twinpuck run --replay FILE`, with any outputs,
        does the run so far again and compares its digest. The programs that ran lie in FILE.images, for their sources may
        be others by then. Raises OSError when it cannot be written."""
        if wrong := self._core.save_recording(os.fsencode(file)):
            raise OSError(wrong)

    def __repr__(self) -> str:
        if self._core is None:
            return "<World, not opened>"
        if not self._core.is_open:
            return "<World, closed>"
        return f"<World {self._core.title or os.path.basename(self._file)!r}, {self.time_s:.3f} s, {self.robots!r}>"


def _check_seed(seed: int | None) -> None:
    if seed is not None and not (isinstance(seed, numbers.Integral) and 0 <= seed < 2**64):
        raise WorldError(f"World: seed: got {seed!r}, expected a whole number from 0 to 2**64 - 1")


class Text(typing.NamedTuple):
    """A world's text, and the file that it is of, or would be: where relative names begin. `is_of`: "file", or "text" and
    "dict", of which there is no such file."""

    text: str
    file: str
    is_of: str = "file"


def text_in(source: typing.Any, folder: str | os.PathLike[str]) -> typing.Any:
    """A dict or text so that relative names in it begin in `folder`; anything else as it is."""
    is_of = "text"
    if isinstance(source, collections.abc.Mapping):
        source, is_of = toml_text(source), "dict"
    elif not isinstance(source, str) or "\n" not in source:
        return source
    return Text(_arguments.fit("World: source", "str", source), os.path.join(os.path.abspath(folder), "world.toml"), is_of)


def read(source: Source) -> Text:
    """What World opens."""
    source = text_in(source, os.getcwd())
    if isinstance(source, Text):
        return source
    name = os.fspath(_arguments.fit("World: source", "world", source))
    if not name:
        raise WorldError(f"World: source: got {source!r}, expected {_arguments.KINDS['world'][1]}")
    try:
        path = _core.find_world(name)
    except ValueError as wrong:
        raise WorldError(str(wrong)) from None
    try:
        return Text(_core.read_world(path), os.path.abspath(path))
    except ValueError as wrong:
        raise OSError(str(wrong)) from None


def _choices(firmware: Firmware, folder: pathlib.Path) -> list[tuple[str, str]]:
    """By robot; paths are made whole, so that a recording finds them from anywhere."""
    if firmware is None:
        return []
    if not isinstance(firmware, collections.abc.Mapping):
        firmware = {"*": firmware}
    return [(robot, _whole(os.fspath(program), folder)) for robot, program in _by_robot(firmware)]


def _by_robot(choices: collections.abc.Mapping[str, typing.Any]) -> list[tuple[str, typing.Any]]:
    """As the simulator takes them: of two that mean a robot the later one, so "*" comes first."""
    return sorted(choices.items(), key=lambda choice: choice[0] != "*")


def _whole(program: str, folder: pathlib.Path) -> str:
    for base in (folder, pathlib.Path.cwd()):
        if (base / program).exists():
            return os.path.abspath(base / program)
    return program
