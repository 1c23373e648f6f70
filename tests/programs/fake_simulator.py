# SPDX-License-Identifier: MIT
"""The simulator's end of the link, for tests of what programs link with: it answers as it is told, and keeps what the
program said. Records are those of programs/link/messages.def."""
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
ROWS = {}     # number -> (name, members)
NUMBERS = {}  # name -> number
for _number, _name, _who, _members in re.findall(r'^LINK_RECORD\((\d+), (\w+), (\w+),\s*"(\w*)"',
                                                 open(ROOT + "/programs/link/messages.def").read(), re.M):
    ROWS[int(_number)] = (_name, _members)
    NUMBERS[_name] = int(_number)

MOST_BYTES = 131072


def record(name, *values):
    """Its bytes."""
    members = ROWS[NUMBERS[name]][1]
    assert len(members) == len(values), (name, members, values)
    body = b""
    for kind, value in zip(members, values):
        if kind == "i":
            body += struct.pack("<q", value)
        elif kind == "f":
            body += struct.pack("<d", value)
        elif kind == "s":
            value = value.encode() if isinstance(value, str) else value
            body += struct.pack("<q", len(value)) + value + bytes(-len(value) % 8)
        else:
            body += struct.pack("<q%dd" % len(value), len(value), *value)
    return struct.pack("<II", NUMBERS[name], len(body)) + body


def records(packet):
    """(name, member, ...) of each."""
    at = 0
    while at < len(packet):
        number, size = struct.unpack_from("<II", packet, at)
        name, members = ROWS[number]
        at, end = at + 8, at + 8 + size
        values = []
        for kind in members:
            count = struct.unpack_from("<q", packet, at)[0]
            if kind == "i":
                values.append(count)
            elif kind == "f":
                values.append(struct.unpack_from("<d", packet, at)[0])
            elif kind == "s":
                values.append(packet[at + 8:at + 8 + count])
                at += count + -count % 8
            else:
                values.append(list(struct.unpack_from("<%dd" % count, packet, at + 8)))
                at += 8 * count
            at += 8
        assert at == end, (name, values)
        yield (name, *values)


class Run:
    """What came of a program."""

    def __init__(self, said, status, out, err):
        self.said, self.status, self.out, self.err = said, status, out, err

    def of(self, name):
        """Its records of that name, without the name."""
        return [r[1:] for r in self.said if r[0] == name]


class Simulator:
    """`devices`: (tag, kind, name, numbers). `samples(step)` gives the records before DONE. `answers`: name of a question
    -> function of its members that gives a record. After `steps` steps the run is over."""

    def __init__(self, devices=(), samples=lambda step: b"", answers=None, steps=3, supervisor=False, step_ms=32):
        self.devices, self.samples, self.answers, self.steps = devices, samples, answers or {}, steps
        self.supervisor, self.step_ms = supervisor, step_ms

    def run(self, command, folder=None, seconds=20, environment=None):
        """Starts the program, and is its simulator until it has gone."""
        mine, its = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        mine.settimeout(seconds)
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            process = subprocess.Popen(command, cwd=folder, pass_fds=[its.fileno()], stdout=out, stderr=err, stdin=subprocess.DEVNULL,
                                       env=dict(os.environ, TWINPUCK_CONTROLLER="fd:%d" % its.fileno(), **(environment or {})))
            its.close()
            self.printed = lambda: os.pread(out.fileno(), 1 << 20, 0).decode()
            try:
                said = self._serve(mine)
                mine.close()
                status = process.wait(seconds)
            finally:
                process.kill()
                process.wait()
            out.seek(0)
            err.seek(0)
            return Run(said, status, out.read().decode(), err.read().decode())

    def _serve(self, line):
        said, steps, ms = [], 0, 0
        while True:
            try:
                packet = line.recv(MOST_BYTES)
            except ConnectionResetError:
                packet = b""
            if not packet:
                return said
            answer = b""
            for name, *members in records(packet):
                said.append((name, *members))
                if name == "HELLO":
                    answer += record("WELCOME", 2, int(self.supervisor), 0, 0, 7, 0, "puck", "e-puck", "/project", "world.toml",
                                     "a title", "custom", self.step_ms, 0.00628)
                    answer += b"".join(record("DEVICE", tag, kind, called, "", numbers) for tag, kind, called, numbers in self.devices)
                    answer += record("READY")
                elif name == "STEP":
                    steps += members[0] > 0
                    ms += members[0]
                    if steps > self.steps:
                        answer += record("END")
                    else:
                        answer += self.samples(steps) + record("DONE", ms * 1000000, members[0])
                elif name in self.answers:
                    answer += self.answers[name](*members)
                elif name.startswith(("FIND", "GET", "ASK", "IMPORT")):
                    answer += record("NOTHING", "the fake simulator has none")
            if answer:
                line.send(answer)


def python(program, simulator, *arguments, interpreter=sys.executable, environment=None):
    """Runs a program of Python's, given as text, with the package of the tree and the library of the build."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "program.py")
        with open(name, "w", encoding="utf-8") as file:
            file.write(program)
        paths = os.pathsep.join([os.path.join(ROOT, "programs", "controller", "python"), os.environ.get("PYTHONPATH", "")])
        return simulator.run([interpreter, "-B", name, *arguments], folder, environment={"PYTHONPATH": paths, **(environment or {})})
