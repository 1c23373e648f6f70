# SPDX-License-Identifier: MIT
"""One robot of a world."""
from __future__ import annotations

import dataclasses
import math
import re
import typing

from ._arguments import checked
from ._errors import ExpectTimeout, TwinpuckError, WorldError

if typing.TYPE_CHECKING:
    import numpy

    from ._world import World

Pattern = typing.Union[str, bytes, "re.Pattern[str]", "re.Pattern[bytes]"]


@dataclasses.dataclass(frozen=True)
class Place:
    """A place in a program's sources: function, file, line. Empty or 0 where it is not known."""

    function: str
    file: str
    line: int

    def __str__(self) -> str:
        return f"{self.function} ({self.file}:{self.line})" if self.file else self.function.strip("?") or "an unknown place"


@dataclasses.dataclass(frozen=True)
class Trap:
    """Why a program stopped, or was reset without asking for it.

    kind: "math error", "address error" ...; vector: the interrupt; message: one sentence; place: where in the source;
    time_s: world time (s); cycle: of the robot's clock; backtrace: from the place outwards; count: how often
    """

    robot: str
    kind: str
    vector: str
    message: str
    place: Place
    time_s: float
    cycle: int
    backtrace: tuple[str, ...]
    count: int

    def __str__(self) -> str:
        times = f" ({self.count} times)" if self.count > 1 else ""
        lines = [f"{self.robot}: {self.place}: {self.kind}: {self.message}{times}",
                 f"  at cycle {self.cycle}, {self.time_s:.6f} s"]
        return "\n".join(lines + [f"  called from {place}" for place in self.backtrace[1:]])


@dataclasses.dataclass(frozen=True)
class Diagnosis:
    """What board or chip has to say about a program (docs/controllers.md).

    time_s: when first (s); count: how often since power-up
    """

    cause: str
    place: str
    message: str
    hint: str
    time_s: float
    count: int

    def __str__(self) -> str:
        hint = f"; {self.hint}" if self.hint else ""
        return f"{self.time_s:.6f} s: {self.place}: {self.cause}: {self.message}{hint}"


@dataclasses.dataclass(frozen=True)
class Cycles:
    """What calls of a function, services of an interrupt or waits took, in cycles of the processor (14,745,600 a second).

    count: how many; 0: not from a run, by the code alone. mean: None when only the code is known and has several ways
    """

    count: int
    total: int
    min: int
    mean: float | None
    max: int


@dataclasses.dataclass(frozen=True)
class Interrupt:
    """An interrupt's services, from entry to RETFIE, without those that interrupt them.

    latency: from the flag to the handler's first instruction; period: from flag to flag; merged: events that came while
    the flag was set; missed: flags that the program cleared although they were enabled and not served
    """

    cycles: Cycles
    latency: Cycles
    period: Cycles
    merged: int
    missed: int


@dataclasses.dataclass(frozen=True)
class Profile:
    """Where a measured robot's time went, exact to the cycle (docs/time.md).

    functions: by name, callees included, handlers not; own: cycles of a function's own code, all calls together;
    interrupts: by name ("T1"); load: share of the time neither asleep nor waiting, 0 to 1; turn: of the main loop;
    stack_bytes: the deepest stack; stack_free: bytes of RAM above it
    """

    cycles: int
    load: float
    functions: dict[str, Cycles]
    own: dict[str, int]
    interrupts: dict[str, Interrupt]
    turn: Cycles
    stack_bytes: int
    stack_free: int
    stack_path: str


@dataclasses.dataclass(frozen=True)
class CameraPicture:
    """A picture that a program got from its camera. number: of this robot's, from 1; rgb: rows, columns, 3; 0 to 255."""

    number: int
    rgb: numpy.ndarray


@dataclasses.dataclass
class LineState:
    """How far expect() has come on a line; what was looked for last, and whether it was there. The world keeps it."""

    searched: int = 0
    looked_at: tuple[typing.Any, int, int] | None = None
    found: bool = False


@checked
class SerialLine:
    """One of a robot's serial lines: UART 1, which is its Bluetooth module's, or UART 2. Times are the baud rate's."""

    __slots__ = ("_robot", "_port")

    def __init__(self, robot: Robot, port: int) -> None:
        self._robot, self._port = robot, port

    @property
    def _state(self) -> LineState:
        return self._robot.world._lines.setdefault((self._robot.index, self._port), LineState())

    @property
    def data(self) -> bytes:
        """All bytes that the robot has sent so far."""
        return self._robot._core.heard(self._robot.index, self._port)

    @property
    def text(self) -> str:
        """The same as text; each byte is a character (Latin-1), so nothing is lost."""
        return self.data.decode("latin-1")

    @property
    def lines(self) -> list[str]:
        """The same by lines, which end with CR, LF or both; without empty ones. The last may not be whole yet."""
        return [line for line in re.split(r"[\r\n]+", self.text) if line]

    def send(self, data: str | bytes) -> None:
        """Sends bytes to the robot, also an array of them; they arrive at the line's rate. Of text each character is a byte,
        up to U+00FF.

        Most programs want a line to end with "\\r". Raises ValueError for other characters, or where the line's other
        end is taken (uart1="pty").
        """
        text = data.decode("latin-1") if isinstance(data, bytes) else data
        self._robot._apply("type", port=self._port, bytes=text)

    def expect(self, pattern: Pattern, at_most: float = 1.0) -> re.Match[typing.Any]:
        """Runs the world until the robot has sent what `pattern` (a regular expression) matches; returns the match.

        Looks behind the last match of expect() only, so several calls follow one another through a dialogue; text
        that came before the call counts. Bytes are matched by a pattern of bytes. at_most: simulated seconds; then
        ExpectTimeout is raised, with the last lines and where the program stands. re.escape() makes text a pattern.
        """
        __tracebackhide__ = True  # a test's failure shows the test's line
        compiled = typing.cast("re.Pattern[typing.Any]", pattern)
        if not self._robot.world.run_until(lambda: self.has(compiled), at_most):
            raise ExpectTimeout(self.missing(compiled, at_most))
        found = self._match(compiled)
        assert found is not None
        self._state.searched = found.end()
        return found

    def has(self, pattern: Pattern) -> bool:
        """Would expect() find the pattern at once? Looks at what came since it was asked last."""
        compiled = typing.cast("re.Pattern[typing.Any]", pattern)
        state = self._state
        looked_at = (compiled, state.searched, self._robot._core.heard_bytes(self._robot.index, self._port))
        if looked_at != state.looked_at:
            state.looked_at, state.found = looked_at, self._match(compiled) is not None
        return state.found

    def _match(self, compiled: re.Pattern[typing.Any]) -> re.Match[typing.Any] | None:
        return compiled.search(self.data if isinstance(compiled.pattern, bytes) else self.text, self._state.searched)

    def missing(self, pattern: re.Pattern[typing.Any], at_most: float) -> str:
        """What expect() says when it has waited in vain."""
        rest = self.text[self._state.searched:]
        came = f"got {rest[-400:]!r} behind the last match" if rest else "nothing came"
        return (f"robot '{self._robot.name}' uart{self._port}: expected {pattern.pattern!r} within {at_most:g} s, {came}; "
                f"at {self._robot.world.time_s:.3f} s the program stands in {self._robot.place}")

    def __repr__(self) -> str:
        return f"<uart{self._port} of {self._robot.name}, {len(self.data)} bytes>"


@checked
class Robot:
    """One robot of a world. It is asked, and touched, between ticks; nothing that is asked changes its course."""

    # it keeps its world, which keeps no robot: a world ends when nobody uses it or a robot of it any more
    __slots__ = ("world", "index", "name", "__weakref__")

    def __init__(self, world: World, index: int, name: str) -> None:
        self.world, self.index, self.name = world, index, name

    @property
    def uart1(self) -> SerialLine:
        """Its line to the Bluetooth module."""
        return SerialLine(self, 1)

    @property
    def uart2(self) -> SerialLine:
        """Its RS232 line."""
        return SerialLine(self, 2)

    def __repr__(self) -> str:
        return f"<Robot {self.name!r} at ({self.x_m:.3f}, {self.y_m:.3f}) m, {self.heading_deg:.0f} deg>"

    @property
    def _core(self) -> typing.Any:
        return self.world._core

    def _apply(self, what: str, **values: typing.Any) -> None:
        self.world._apply({"do": what, "robot": self.name, **values})

    # --- where it is
    @property
    def x_m(self) -> float:
        """East (m)."""
        return self._core.pose(self.index)[0]

    @property
    def y_m(self) -> float:
        """North (m)."""
        return self._core.pose(self.index)[1]

    @property
    def heading_rad(self) -> float:
        """Where it looks (rad), 0 east, counter-clockwise; not held within a turn."""
        return self._core.pose(self.index)[2]

    @property
    def heading_deg(self) -> float:
        """Where it looks (degrees), above -180 and up to 180; 0 east, 90 north."""
        return 180.0 - (180.0 - math.degrees(self.heading_rad)) % 360.0

    @property
    def position_m(self) -> tuple[float, float]:
        """(x, y) in m."""
        return self._core.pose(self.index)[:2]

    @property
    def distance_m(self) -> float:
        """Way travelled over the floor (m); moves by hand do not count."""
        return self._core.distance_m(self.index)

    @property
    def collisions(self) -> int:
        """How often it has begun to touch a wall, a thing or a robot."""
        return self._core.touches(self.index)[0]

    @property
    def longest_wall_touch_s(self) -> float:
        """Its longest touch of a wall (s)."""
        return self._core.touches(self.index)[1]

    def move(self, x_m: float, y_m: float, heading_deg: float | None = None) -> None:
        """Puts it somewhere else by hand, at rest. Without heading it looks where it looked."""
        heading_rad = self.heading_rad if heading_deg is None else math.radians(heading_deg)
        self._apply("move", x=float(x_m), y=float(y_m), heading=heading_rad)

    # --- what it shows
    @property
    def leds(self) -> tuple[bool, ...]:
        """The eight LEDs of the ring, from the front clockwise."""
        mask = self._core.report(self.index)[2]
        return tuple(bool(mask >> i & 1) for i in range(8))

    @property
    def body_led(self) -> bool:
        """The green LED in its body."""
        return bool(self._core.report(self.index)[2] >> 8 & 1)

    @property
    def front_led(self) -> bool:
        """The red LED at its front."""
        return bool(self._core.report(self.index)[2] >> 9 & 1)

    @property
    def steps(self) -> tuple[int, int]:
        """Motor steps of the left and the right wheel since power-up, not wrapped; 1000 are a turn."""
        return self._core.report(self.index)[:2]

    def pin(self, name: str) -> bool:
        """Level of a pin of the processor, such as "D3". Raises ValueError for another name."""
        try:
            return self._core.pin(self.index, name)
        except ValueError as wrong:
            raise ValueError(f"robot '{self.name}': {wrong}") from None

    # --- what it senses
    @property
    def proximity(self) -> tuple[int, ...]:
        """What e_get_prox(0) to e_get_prox(7) would give (counts). world.proximity has it for all robots."""
        return tuple(self._core.proximity(self.index, i) for i in range(8))

    @property
    def selector(self) -> int:
        """Position of the rotary switch, 0 to 15."""
        return self._core.selector(self.index)

    @selector.setter
    def selector(self, position: int) -> None:
        self._apply("selector", position=position)

    @property
    def battery_v(self) -> float:
        """Volts at the battery's terminals. It can be set, from 3.0 to 4.2."""
        return self._core.battery(self.index)

    @battery_v.setter
    def battery_v(self, volts: float) -> None:
        self._apply("battery", volts=float(volts))

    @property
    def camera(self) -> CameraPicture | None:
        """The last picture that the program got from its camera; None: none yet."""
        picture = self._core.picture(self.index)
        return None if picture is None else CameraPicture(*picture)

    def press_key(self, key: int, hold_s: float = 0.1, address: int = 0) -> None:
        """Somebody presses a key of a remote control (RC5), 0 to 63, for so long (s)."""
        self._apply("key", key=key, hold=float(hold_s), address=address)

    def define_sensor(self, name: str, value: float) -> None:
        """Defines a virtual sensor, as a supervisor does; programs read it with twinpuck_virtual_sensor()."""
        if not name:
            raise ValueError("define_sensor: name: got '', expected a name")
        self._apply("sensor", name=name, value=float(value))

    def press_reset(self) -> None:
        """Its reset button: the program begins anew, also after a trap."""
        self._apply("reset")

    def signal(self, name: str) -> float:
        """A signal of this robot now, in its unit (`twinpuck list signals`): "speed_m_s", "pin(D3)", "$state"."""
        return self.world.condition(name, self).value

    # --- its program
    @property
    def program(self) -> str:
        """The folder or file that it runs; empty: none."""
        return self._core.program(self.index)[0]

    @property
    def image(self) -> str:
        """The file that was made of it, or that it is: an .elf or .hex."""
        return self._core.program(self.index)[1]

    @property
    def hal(self) -> str:
        """What its program is linked with: "sim", "dspic", "own" for a file from elsewhere; empty: not of the chip."""
        return self._core.program(self.index)[2]

    def variable(self, expression: str) -> typing.Any:
        """What an expression of C is worth where the program stands: a number, a list (array) or a dict (struct).

        Variables and their parts (motors[1].speed, m->speed, *p), registers (T1CON, PORTDbits.RD3, w0, pc), and C's
        operators: "count > 10 && state == RUN". A pointer is its address. None: the optimiser keeps it nowhere here.
        Raises ValueError, with a guess for names that are near. Variables must be global or static, or of the function
        that runs.
        """
        return self._value("variable", expression)

    def _value(self, what: str, expression: str) -> typing.Any:
        try:
            return self._core.value(self.index, expression)
        except ValueError as wrong:
            raise ValueError(f"{what} {expression!r}: {wrong}") from None

    def set_variable(self, expression: str, value: typing.Any) -> None:
        """Changes a variable, an element, a member or a register, as an assignment of C would.

        A list or an array of NumPy fills an array, a dict members of a struct. Raises ValueError; nothing is changed
        then.
        """
        self._core.assign(self.index, expression, value)

    def text_variable(self, expression: str) -> str:
        """A char array up to its first 0, as text (Latin-1)."""
        values = self.variable(expression)
        if not isinstance(values, list):
            raise ValueError(f"variable {expression!r}: got {values!r}, expected an array of char")
        return bytes(v & 0xFF for v in values).split(b"\0")[0].decode("latin-1")

    def register(self, name: str) -> int:
        """A register of the chip or the processor by its name in the data sheet: "T1CON", "LATA", "w0"."""
        if name != "pc" and not self._core.is_register(name):
            raise ValueError(f"register: got {name!r}, expected a register, such as 'T1CON' or 'w0'")
        return self._value("register", name)

    @property
    def cycles(self) -> int:
        """Cycles of the processor since power-up."""
        return self._core.cycles(self.index)

    @property
    def load(self) -> float:
        """Share of its cycles in which the program did anything but wait, 0 to 1."""
        return self._core.load(self.index)

    @property
    def interrupts_served(self) -> int:
        """Handlers that have returned."""
        return self._core.interrupts_served(self.index)

    @property
    def place(self) -> Place:
        """Where the program stands: the line that it executes, or waits or was stopped in."""
        return Place(*self._core.place(self.index))

    @property
    def has_stopped(self) -> bool:
        """A trap has stopped it until somebody presses reset."""
        return self._core.has_stopped(self.index)

    def why(self) -> str:
        """What the program waits for, who could end that, and what is pending; as the debugger's `why`."""
        return self._core.why(self.index)

    @property
    def console(self) -> list[str]:
        """Lines that a program for Webots' interfaces has written."""
        return self._core.console(self.index)

    @property
    def traps(self) -> list[Trap]:
        """Traps and unexpected resets so far, in order of time."""
        return [_trap(t) for t in self._core.traps(self.index)]

    @property
    def diagnoses(self) -> list[Diagnosis]:
        """What board and chip have to say about the program so far, in order of time."""
        return [Diagnosis(**d) for d in self._core.diagnoses(self.index)]

    # --- its time
    def profile(self) -> Profile:
        """Where its time went. The world must have been opened with measured=[its name], or ["*"]."""
        raw = self._core.profile(self.index)
        if raw is None:
            raise TwinpuckError(f"robot '{self.name}': profile: got a robot that is not measured, expected one of "
                                f"World(measured=['{self.name}'])")
        return Profile(
            cycles=raw["cycles"], load=raw["load"],
            functions={name: _cycles(f) for name, f in raw["functions"].items()},
            own={name: f["own"] for name, f in raw["functions"].items()},
            interrupts={name: Interrupt(_cycles(i), _cycles(i["latency"]), _cycles(i["period"]), i["merged"], i["missed"])
                        for name, i in raw["interrupts"].items()},
            turn=_cycles(raw["turn"]), stack_bytes=raw["stack_bytes"], stack_free=raw["stack_free"],
            stack_path=raw["stack_path"])

    def cost_of(self, function: str) -> Cycles:
        """Exact cycles of a call of a function, callees included, handlers not.

        Of the run so far, if the robot is measured and has called it; else by its code, where that tells. Raises
        WorldError for a function that the program has not, or that only a run can tell (it loops).
        """
        try:
            return Cycles(*self._core.cost_of(self.index, function))
        except ValueError as wrong:
            raise WorldError(f"robot '{self.name}': cost_of: {wrong}") from None


def _cycles(raw: dict[str, typing.Any]) -> Cycles:
    return Cycles(raw["count"], raw["total"], raw["min"], raw["mean"], raw["max"])


def _trap(raw: dict[str, typing.Any]) -> Trap:
    return Trap(robot=raw["robot"], kind=raw["kind"], vector=raw["vector"], message=raw["message"],
                place=Place(raw["function"], raw["file"], raw["line"]), time_s=raw["time_s"], cycle=raw["cycle"],
                backtrace=tuple(raw["backtrace"]), count=raw["count"])
