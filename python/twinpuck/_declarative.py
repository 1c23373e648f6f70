# SPDX-License-Identifier: MIT
"""Tests without a program: *.test.toml files. One table of keys gives checks, messages and a part of docs/testing.md."""
from __future__ import annotations

import collections.abc
import dataclasses
import difflib
import math
import pathlib
import re
import sys
import tomllib
import typing

from . import _matrix
from ._errors import InvalidRun, TwinpuckError
from ._robot import Robot
from ._world import Condition, World
from ._worldtext import toml_key, toml_value


@dataclasses.dataclass(frozen=True)
class Key:
    """A key of a table: its kind ("text", "number", "whole", "condition", "numbers", "list"), unit, range, meaning; of a
    step also the actions that it goes with (none: all)."""

    name: str
    kind: str
    does: str
    unit: str = ""
    least: float = -math.inf
    most: float = math.inf
    usual: typing.Any = None
    of: tuple[str, ...] = ()


_HEAD = (
    Key("world", "text", "**required**; a world file, relative to this one, or the name of one of Twinpuck's worlds"),
    Key("title", "text", "the test's name", usual="what the file is called"),
    Key("firmware", "text", "what all robots run instead of what the world says; `--firmware` goes before"),
    Key("robot", "text", "the robot that steps and conditions are about", usual="the world's first"),
    Key("at_most_s", "number", "all steps together; without steps the test runs so long", "s", 0, 1e6, 60),
    Key("seeds", "list", "the test runs with each of these seeds: `\"1..50\"`, `[1, 7]`"),
    Key("hals", "list", "... with programs linked with each of these: `\"sim,dspic\"`"),
    Key("selectors", "list", "... with the selector in each of these positions: `\"0..15\"`"),
    _POINTS := Key("points", "number", "of `twinpuck grade`", "", 0, 1e6, 1),
)
_WHO = Key("robot", "text", "another robot than the test's")
_BECAUSE = Key("because", "text", "said when it fails")
_WITHIN = Key("within_s", "number", "how long an `expect` or `wait` may take", "s", 0, 1e6, "up to the test's end",
              ("expect", "wait"))
_UART = Key("uart", "whole", "which line `expect` and `send` mean", "", 1, 2, 1, ("expect", "send"))
_ACTIONS = (
    Key("expect", "text", "runs until the robot has sent what this regular expression matches, behind the last match"),
    Key("send", "text", "sends these characters to the robot, each a byte; most programs want `\\r` at the end"),
    Key("wait", "condition", "runs until a condition over signals holds, or for a time (s)"),
    Key("press", "whole", "presses a key of a remote control", "", 0, 63),
    Key("turn", "whole", "turns the selector", "", 0, 15),
    Key("move", "numbers", "puts the robot to `[x, y, heading]`", "m, degrees", -1000, 1000),
    Key("battery", "number", "gives the battery this voltage", "V", 3.0, 4.2),
    Key("set", "text", "changes a variable: `\"speed = 300\"`"),
    Key("reset", "whole", "presses the reset button, once", "", 1, 1),
)
_STEP = (*_ACTIONS, _WITHIN, _UART, Key("hold_s", "number", "how long a key is held", "s", 0, 60, 0.1, ("press",)),
         Key("address", "whole", "of the remote control", "", 0, 31, 0, ("press",)), _WHO, _BECAUSE)
_THAT = Key("that", "condition", "**required**; a condition over signals: `\"collisions == 0\"`")
_WATCH = (_THAT, Key("from_s", "number", "looked at from this time on", "s", 0, 1e6, 0),
          Key("to_s", "number", "... and up to this time", "s", 0, 1e6, "the test's end"), _WHO, _BECAUSE)
_FINALLY = (_THAT, _WHO, _BECAUSE)

#: tables of a file: what they are, and their keys
TABLES: dict[str, tuple[str, tuple[Key, ...]]] = {
    "": ("The file itself.", _HEAD),
    "step": ("What is done, one after the other. A step has one of the first keys.", _STEP),
    "always": ("What holds at each tick of the test.", _WATCH),
    "never": ("What holds at no tick of the test.", _WATCH),
    "finally": ("What holds when all steps are done.", _FINALLY),
}


#: tables that are read as those of a file of faults are
_FAULTS = ("fault", "stimulus")


class TestFileError(TwinpuckError, ValueError):
    """A test file is wrong; a line a problem."""

    __module__ = "twinpuck"


class TestFailed(TwinpuckError, AssertionError):
    """What a test file expects is not so."""

    __module__ = "twinpuck"


class TestFile:
    """A *.test.toml file, read and checked. Raises TestFileError with all that is wrong."""

    def __init__(self, path: pathlib.Path) -> None:
        self.path = path
        try:
            self._text = path.read_text(encoding="utf-8-sig")
            self.table = tomllib.loads(self._text)
        except OSError as wrong:
            raise TestFileError(f"{path}: cannot be read: {wrong.strerror}") from None
        except ValueError as wrong:  # of UTF-8, or of TOML
            raise TestFileError(f"{path}: not TOML: {wrong}") from None
        self._problems: list[str] = []
        self._check("", self.table, {*(name for name in TABLES if name), *_FAULTS}, str(path))
        for kind in list(TABLES)[1:]:
            for number, table in enumerate(self.tables(kind)):
                self._check(kind, table, set(), self.where(kind, number))
        if "world" not in self.table:
            self._problems.append(f"{path}: test.world: missing, expected a world file or the name of a world")
        for number, step in enumerate(self.tables("step")):
            self._problems += [f"{self.where('step', number)}: {wrong}" for wrong in _wrong_step(step)]
        for kind in ("always", "never"):
            for number, table in enumerate(self.tables(kind)):
                from_s, to_s = table.get("from_s", 0), table.get("to_s", math.inf)
                if isinstance(from_s, (int, float)) and isinstance(to_s, (int, float)) and from_s > to_s:
                    self._problems.append(f"{self.where(kind, number)}: {kind}.to_s: got {to_s:g}, expected {from_s:g} s "
                                          "(from_s) or more")
        for axis in _matrix.AXES:
            try:
                self.values(axis)
            except ValueError as wrong:
                self._problems.append(f"{path}: test.{axis.marker}: {str(wrong).removeprefix(f'--{axis.option}: ')}")
        if self._problems:
            raise TestFileError("\n".join(self._problems))

    @property
    def title(self) -> str:
        """The test's name."""
        return self.table.get("title", self.path.name.removesuffix(".test.toml"))

    def tables(self, kind: str) -> list[dict[str, typing.Any]]:
        """All [[step]], [[always]] ... of the file."""
        found = self.table.get(kind, [])
        return [t for t in found if isinstance(t, dict)] if isinstance(found, list) else []

    def values(self, axis: _matrix.Axis) -> list[typing.Any]:
        """What the file says of seeds, HALs or selectors."""
        value = self.table.get(axis.marker)
        return axis.marked(None if value is None else [value])

    def where(self, kind: str, number: int) -> str:
        """"FILE:LINE" of the table of that number."""
        heads = [i for i, line in enumerate(self._text.splitlines(), 1)
                 if re.match(rf"\s*\[\[\s*\"?{kind}\"?\s*\]\]", line)]
        return f"{self.path}:{heads[number]}" if number < len(heads) else str(self.path)

    def _check(self, kind: str, table: dict[str, typing.Any], tables: set[str], where: str) -> None:
        known = {key.name: key for key in TABLES[kind][1]}
        what = kind or "test"
        for name, value in table.items():
            if name in tables:
                if not isinstance(value, list) or not all(isinstance(v, dict) for v in value):
                    self._problems.append(f"{where}: {name}: got {value!r}, expected [[{name}]] tables")
            elif name not in known:
                near = difflib.get_close_matches(name, [*known, *tables], 1)
                self._problems.append(f"{where}: unknown key '{name}' in {what}" +
                                      (f"; did you mean '{near[0]}'?" if near else "") +
                                      f" (keys: {', '.join([*known, *sorted(tables)])})")
            elif wrong := _wrong(known[name], value):
                self._problems.append(f"{where}: {what}.{name}: got {value!r}, expected {wrong}")
        if _THAT in TABLES[kind][1] and "that" not in table:
            self._problems.append(f"{where}: {what}.that: missing, expected a condition")


def _wrong_step(step: dict[str, typing.Any]) -> list[str]:
    """What is wrong with a step, but for its values' kinds and ranges."""
    actions = [key.name for key in _ACTIONS if key.name in step]
    if len(actions) != 1:
        return [f"step: got {' and '.join(actions) or 'nothing'} to do, expected one of "
                f"{', '.join(key.name for key in _ACTIONS)}"]
    action, wrong = actions[0], []
    value = step[action]
    for key in _STEP:
        if key.name in step and key.of and (action not in key.of or action == "wait" and not isinstance(value, str)):
            wanted = " or ".join(f"{name} for a condition" if name == "wait" else name for name in key.of)
            wrong.append(f"step.{key.name}: got it with {action}{' for a time' if action in key.of else ''}, expected it "
                         f"with {wanted} only")
    if action == "expect" and isinstance(value, str):
        try:
            re.compile(value)
        except re.error as error:
            wrong.append(f"step.expect: got {value!r}, expected a regular expression: {error}")
    if action == "send" and isinstance(value, str) and (beyond := [c for c in value if c > "\xff"]):
        wrong.append(f"step.send: got {beyond[0]!r}, expected characters up to U+00FF, each a byte")
    if action == "set" and isinstance(value, str) and "=" not in value:
        wrong.append(f"step.set: got {value!r}, expected \"variable = value\"")
    return wrong


def _wrong(key: Key, value: typing.Any) -> str:
    """What a value should have been; empty: it is."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    limits = f" from {key.least:g} to {key.most:g}" + (f" {key.unit}" if key.unit else "") \
        if math.isfinite(key.least) else ""
    in_range = is_number and key.least <= value <= key.most
    if key.kind == "text":
        return "" if isinstance(value, str) else "text in quotes"
    if key.kind == "number":
        return "" if in_range else "a number" + limits
    if key.kind == "whole":
        return "" if in_range and isinstance(value, int) else "a whole number" + limits
    if key.kind == "numbers":
        fits = isinstance(value, list) and len(value) == 3 and all(
            isinstance(v, (int, float)) and not isinstance(v, bool) and abs(v) <= key.most for v in value)
        return "" if fits else "three numbers [x, y, heading] (m, m, degrees)"
    if key.kind == "condition":
        is_time = key.name == "wait" and is_number and 0 <= value <= 1e6
        return "" if isinstance(value, str) or is_time else "a condition in quotes" + (
            " or a time from 0 to 1e6 s" if key.name == "wait" else "")
    return "" if isinstance(value, (str, int, list)) and not isinstance(value, bool) else "text, a number or a list"


@dataclasses.dataclass
class _Watch:
    """An [[always]] or [[never]]: what must not become so, where it stands, from when to when."""

    where: str
    kind: str
    condition: Condition
    from_s: float
    to_s: float
    because: str
    was_looked_at: bool = False

    def is_broken(self, now_s: float) -> bool:
        if not self.from_s <= now_s <= self.to_s:
            return False
        self.was_looked_at = True
        return self.condition() == (self.kind == "never")

    def missed(self, now_s: float) -> str:
        window = f"from {self.from_s:g} s" + (f" to {self.to_s:g} s" if math.isfinite(self.to_s) else "")
        return f"{self.where}: {self.kind}: never looked at: the run ended at {now_s:.3f} s and had no tick {window}"

    def told(self, now_s: float) -> str:
        hope = "always" if self.kind == "always" else "never"
        return f"{self.where}: {self.kind}: expected {hope} {self.condition.text!r}, got " \
               f"{'otherwise' if hope == 'always' else 'it'} at {now_s:.3f} s{self.because}"


class Run:
    """One run of a test file over a world that has just been opened."""

    def __init__(self, file: TestFile, world: World) -> None:
        self._file, self._world = file, world
        self._robot({}, str(file.path))
        self._broken: _Watch | None = None
        self._watches = [
            _Watch(file.where(kind, number), kind, self._condition(kind, number, table, "that"),
                   table.get("from_s", 0.0), table.get("to_s", math.inf), _because(table))
            for kind in ("always", "never") for number, table in enumerate(file.tables(kind))]

        for kind in _FAULTS:
            for number, table in enumerate(file.tables(kind)):
                text = "".join(f"{toml_key(key)} = {toml_value(value, key)}\n" for key, value in table.items())
                try:
                    world._add_faults(f"[[{kind}]]\n{text}")
                except ValueError as wrong:
                    raise TestFileError(re.sub("^inject", file.where(kind, number), str(wrong), flags=re.M)) from None

    def run(self) -> None:
        """Does the steps. Raises TestFailed, with the place in the file; FirmwareFault when a program traps; InvalidRun when
        an [[always]] or [[never]] was looked at at no tick."""
        __tracebackhide__ = True
        steps = self._file.tables("step")
        limit_s = self._file.table.get("at_most_s", 60)
        # what cannot be read shall be told before anything runs
        conditions = {i: self._condition("step", i, step, "wait") for i, step in enumerate(steps)
                      if isinstance(step.get("wait"), str)}
        last = [(self._file.where("finally", i), self._condition("finally", i, table, "that"), _because(table))
                for i, table in enumerate(self._file.tables("finally"))]
        self._look()
        for number, step in enumerate(steps):
            self._step(number, step, conditions.get(number), limit_s)
        if not steps:
            self._go(limit_s, lambda: False)
        wrong = [f"{where}: finally: expected {condition.text!r}, got otherwise at {self._world.time_s:.3f} s{because}"
                 for where, condition, because in last if not condition()]
        if wrong:
            raise TestFailed("\n".join(wrong))
        if missed := [watch.missed(self._world.time_s) for watch in self._watches if not watch.was_looked_at]:
            raise InvalidRun("\n".join(missed))

    def _robot(self, table: dict[str, typing.Any], where: str) -> Robot:
        name = table.get("robot", self._file.table.get("robot"))
        try:
            return self._world.robots[0 if name is None else name]
        except KeyError as wrong:
            raise TestFileError(f"{where}: {wrong.args[0]}") from None

    def _condition(self, kind: str, number: int, table: dict[str, typing.Any], key: str) -> Condition:
        where = self._file.where(kind, number)
        try:
            return self._world.condition(table[key], self._robot(table, where))
        except TestFileError:
            raise
        except TwinpuckError as wrong:
            raise TestFileError(f"{where}: {kind}: {wrong}") from None

    def _look(self) -> bool:
        """Is anything broken that must hold? Told at once."""
        now_s = self._world.time_s
        self._broken = next((watch for watch in self._watches if watch.is_broken(now_s)), None)
        return self._broken is not None

    def _go(self, seconds: float, is_done: collections.abc.Callable[[], bool]) -> bool:
        __tracebackhide__ = True
        done = self._world.run_until(lambda: self._look() or is_done(), seconds)
        if self._broken:
            raise TestFailed(self._broken.told(self._world.time_s))
        return done

    def _step(self, number: int, step: dict[str, typing.Any], condition: Condition | None, limit_s: float) -> None:
        __tracebackhide__ = True
        where = self._file.where("step", number)
        robot = self._robot(step, where)
        line = robot.uart2 if step.get("uart") == 2 else robot.uart1
        left_s = limit_s - self._world.time_s
        within_s = min(step.get("within_s", math.inf), left_s)
        if "send" in step:
            line.send(step["send"])
        elif "press" in step:
            robot.press_key(step["press"], step.get("hold_s", 0.1), step.get("address", 0))
        elif "turn" in step:
            robot.selector = step["turn"]
        elif "move" in step:
            robot.move(*step["move"])
        elif "battery" in step:
            robot.battery_v = step["battery"]
        elif "reset" in step:
            robot.press_reset()
        elif "set" in step:
            self._set(robot, step["set"], where)
        elif "expect" in step:
            self._expect(line, step, where, within_s)
        elif condition is None:
            if step["wait"] > left_s + 1e-9:
                raise TestFileError(f"{where}: step.wait: got {step['wait']} s, expected at most the {left_s:g} s that "
                                    f"are left of at_most_s = {limit_s:g}")
            self._go(step["wait"], lambda: False)
        elif not self._go(max(within_s, 0), condition):
            raise TestFailed(f"{where}: step {number + 1}: expected {condition.text!r} within {within_s:g} s, got "
                             f"otherwise up to {self._world.time_s:.3f} s (it is {condition.value:g}){_because(step)}")

    def _expect(self, line: typing.Any, step: dict[str, typing.Any], where: str, within_s: float) -> None:
        __tracebackhide__ = True
        pattern = re.compile(step["expect"])
        if not self._go(max(within_s, 0), lambda: line.has(pattern)):
            raise TestFailed(f"{where}: {line.missing(pattern, within_s)}{_because(step)}")
        line.expect(pattern, 0)

    def _set(self, robot: Robot, text: str, where: str) -> None:
        name, _, value = text.partition("=")
        try:
            robot.set_variable(name.strip(), robot.variable(value.strip()))
        except ValueError as wrong:
            raise TestFileError(f"{where}: step.set: {wrong}") from None


def is_points(value: typing.Any) -> bool:
    """May a test be worth that?"""
    return not _wrong(_POINTS, value)


def _because(table: dict[str, typing.Any]) -> str:
    return f"; {table['because']}" if "because" in table else ""


def page() -> str:
    """The keys of a test file as docs/testing.md has them."""
    text = [""]
    for name, (does, keys) in TABLES.items():
        text += [f"### {f'`[[{name}]]`' if name else 'Top of a test file'}", "", does, "",
                 "| key | value | unit | range | default | meaning |", "|---|---|---|---|---|---|"]
        for key in keys:
            limits = f"{key.least:g} to {key.most:g}" if math.isfinite(key.least) and key.kind != "numbers" else ""
            usual = "" if key.usual is None else str(key.usual)
            kind = {"text": "text in quotes", "whole": "whole number", "condition": "condition in quotes",
                    "numbers": "three numbers"}.get(key.kind, key.kind)
            if key.name == "wait":
                kind += ", or number (s)"
            text.append(f"| `{key.name}` | {kind} | {key.unit} | {limits} | {usual} | {key.does} |")
        text.append("")
    text += ["`[[fault]]` and `[[stimulus]]` are those of a file of faults. A test whose faults never took effect does not pass.", ""]
    return "\n".join(text)


def with_page(text: str) -> str:
    """A page with these keys as its part "test keys"; ValueError: it has no such part."""
    begin = text.index("\n", text.index("<!-- test keys: ")) + 1
    return text[:begin] + page() + text[text.index("<!-- end -->", begin):]


if __name__ == "__main__":
    if len(sys.argv) > 1:
        file = pathlib.Path(sys.argv[1])
        file.write_text(with_page(file.read_text()))
    else:
        print(page(), end="")
