# SPDX-License-Identifier: MIT
"""The live view from Python: the protocol of docs/connecting.md, as the page speaks it.

    from twinpuck import live

    with live.start("maze", "--fw", "obstacle") as view:       # or live.connect(ADDRESS) to one that runs
        view.ask("subscribe", names=["puck.x", "puck.ir0"])
        view.ask("step", unit="control", count=10)
        frame = view.frame()
        print(frame.time_s, frame.values, frame.poses[0])       # s; x, y, z in m and heading in rad

What cannot be done raises Refused, with the answer's other members in `more`. Nothing here waits for ever: calls give
up after `timeout` seconds of real time with TimeoutError.
"""
import json
import re
import signal
import struct
import subprocess
import time
import urllib.parse
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Optional, Tuple

import websocket

from . import _core
from ._errors import TwinpuckError

_HEAD = struct.Struct("<4sIddIIIIII")


class Refused(TwinpuckError):
    """A request that was not done; `more` holds what the answer has beside the sentence: conflict, anew, ..."""

    def __init__(self, sentence: str, more: Dict[str, Any]):
        super().__init__(sentence)
        self.more = more


@dataclass
class Frame:
    """A state of the world, as the page draws it."""

    revision: int                                       #: of the world event that it belongs to
    time_s: float
    pace: float                                         #: simulated seconds a second
    plays: bool
    ended: bool
    subscription: int                                   #: that `values` are of
    values: Tuple[float, ...]                           #: in the units that the subscription's answer gave
    poses: List[Tuple[float, float, float, float]]      #: robots, then movable things: x, y, z in m, heading in rad
    leds: List[int]                                     #: of each robot, a bit each
    states: List[int]                                   #: of each robot: 1 no program, 2 stopped, 4 waits, 8 sounds
    rays: List[Tuple[float, ...]]                       #: from, to in m; 0 to 1 of the light comes back, -1 nothing met

    @staticmethod
    def read(data: bytes) -> "Frame":
        """A frame of its bytes."""
        if data[:4] != b"TPK1" or len(data) < _HEAD.size:
            raise TwinpuckError(f"frame: got {data[:4]!r} and {len(data)} bytes in all, expected b'TPK1' and {_HEAD.size} or more")
        _, revision, time_s, pace, flags, robots, bodies, values, rays, subscription = _HEAD.unpack_from(data)
        at = _HEAD.size

        def take(code: str, count: int, each: int):
            nonlocal at
            got = struct.unpack_from(f"<{count * each}{code}", data, at)
            at += struct.calcsize(code) * count * each
            return [got[i:i + each] for i in range(0, count * each, each)]
        numbers = tuple(v for (v,) in take("d", values, 1))
        poses = take("f", bodies, 4)
        words = take("I", robots, 2)
        return Frame(revision, time_s, pace, bool(flags & 1), bool(flags & 2), subscription, numbers, poses,
                     [w[0] for w in words], [w[1] for w in words], take("f", rays, 7))


def _changed(world: Dict[str, Any], changes: Dict[str, Any]) -> Dict[str, Any]:
    """A world after an edit."""
    text = changes["text"]
    lines = world["text"].split("\n")
    lines[text["above"]:text["above"] + text["gone"]] = text["lines"]
    changed = dict(changes["head"], text="\n".join(lines))
    for name in ("things", "robots", "elements"):
        pieces = {piece["id"]: piece for piece in world[name] + changes[name]["fresh"]}
        changed[name] = [pieces[number] for number in changes[name]["order"]]
    ends = changes["elements"]["lines"]
    changed["elements"] = [dict(element, line=ends[2 * i], last_line=ends[2 * i + 1])
                           for i, element in enumerate(changed["elements"])]
    return changed


class LiveView:
    """A client of a live view. `hello` is the event with which it greeted: world, programs, state, schema."""

    def __init__(self, address: str, timeout: float = 60.0):
        url = urllib.parse.urlparse(address)
        self.address, self.timeout = address, timeout
        wanted = "expected the address of a live view that runs; `twinpuck view` prints it"
        if not url.netloc:
            raise TwinpuckError(f"{address}: got no host, {wanted}")
        try:
            self._socket = websocket.create_connection(f"ws://{url.netloc}{url.path}live", timeout=timeout,
                                                       suppress_origin=True, enable_multithread=False)
        except (websocket.WebSocketException, OSError) as wrong:
            raise TwinpuckError(f"{address}: got {str(wrong)!r}, {wanted}") from None
        self._events: List[Dict[str, Any]] = []
        self._frame: Optional[Frame] = None
        self._next = 0
        #: The world as it is now, with all edits: title, text, things, robots, elements of the file, problems.
        self.world: Dict[str, Any] = {}
        self._process: Optional[subprocess.Popen] = None
        self.hello = self.event("hello")

    def __enter__(self) -> "LiveView":
        return self

    def __exit__(self, *_) -> None:
        self.close()

    def close(self) -> None:
        """Hangs up; a view that start() began ends."""
        self._socket.close()
        if self._process:
            self._process.send_signal(signal.SIGINT)
            self._process.communicate(timeout=self.timeout)

    def ask(self, do: str, **fields) -> Dict[str, Any]:
        """A request and its answer. Raises Refused."""
        self._next += 1
        try:
            self._socket.send(json.dumps({"do": do, "id": self._next, **fields}))
        except (websocket.WebSocketException, OSError) as wrong:
            raise self._gone() from wrong
        answers: List[Dict[str, Any]] = []
        self._hear(lambda: any(a["answer"] == self._next for a in answers), answers)
        answer = next(a for a in answers if a["answer"] == self._next)
        if "error" in answer:
            more = {key: value for key, value in answer.items() if key not in ("error", "answer")}
            raise Refused(answer["error"], more)
        return answer

    def event(self, name: str, where: Callable[[Dict[str, Any]], bool] = lambda event: True) -> Dict[str, Any]:
        """The next event of that name for which `where` holds; those before it are forgotten."""
        def found() -> bool:
            while self._events:
                self._found = self._events.pop(0)
                if self._found["event"] == name and where(self._found):
                    return True
            return False
        self._hear(found, [])
        return self._found

    def frame(self, where: Callable[[Frame], bool] = lambda frame: True) -> Frame:
        """The next frame for which `where` holds; the one at hand if it does."""
        self._hear(lambda: self._frame is not None and where(self._frame), [])
        assert self._frame is not None
        return self._frame

    def _gone(self) -> TwinpuckError:
        return TwinpuckError(f"{self.address}: got the end of the connection, expected a live view that goes on")

    def _hear(self, until: Callable[[], bool], answers: List[Dict[str, Any]]) -> None:
        give_up = time.monotonic() + self.timeout
        late = f"{self.address}: got nothing within {self.timeout:g} s, expected what was asked for"
        while not until():
            left = give_up - time.monotonic()
            if left <= 0:
                raise TimeoutError(late)
            self._socket.settimeout(left)
            try:
                code, data = self._socket.recv_data()
            except websocket.WebSocketTimeoutException:
                raise TimeoutError(late) from None
            except (websocket.WebSocketException, OSError) as wrong:
                raise self._gone() from wrong
            if code == websocket.ABNF.OPCODE_BINARY:
                self._frame = Frame.read(data)
            elif code == websocket.ABNF.OPCODE_TEXT:
                message = json.loads(data)
                if "world" in message:
                    self.world = message["world"]
                elif message.get("event") == "world_changed":
                    self.world = _changed(self.world, message["changes"])
                (answers if "answer" in message else self._events).append(message)
            elif code == websocket.ABNF.OPCODE_CLOSE:
                raise self._gone()


def connect(address: str, timeout: float = 60.0) -> LiveView:
    """To a live view that runs; `address` as `twinpuck view` prints it. Raises TwinpuckError."""
    return LiveView(address, timeout)


def start(world: str, *options: str, command: Optional[str] = None, cwd=None, env=None,
          timeout: float = 60.0) -> LiveView:
    """Starts `twinpuck view WORLD OPTIONS` and connects to it; it ends with the client."""
    words = [command or _core.command_file(), "view", world, *options]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=cwd, env=env)
    assert process.stdout is not None
    first = process.stdout.readline()
    found = re.match(r"open (\S+)", first)
    if not found:
        _, problems = process.communicate(timeout=timeout)
        raise TwinpuckError(problems.strip() or f"twinpuck view: got exit code {process.returncode}, expected an address")
    view = LiveView(found.group(1), timeout)
    view._process = process
    return view
