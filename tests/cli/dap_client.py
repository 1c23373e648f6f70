# SPDX-License-Identifier: MIT
"""An editor's side of the Debug Adapter Protocol: dap_client.py TWINPUCK FIRMWARE SOURCE. Exit code 0: all as expected."""
import base64
import pathlib
import subprocess
import sys
import tempfile

from dap import Server

TWINPUCK, FIRMWARE, SOURCE = sys.argv[1:]
server = Server(TWINPUCK)


def ask(command, **arguments):
    return server.ask(command, **arguments)


def event(name):
    return server.event(name)


def good(command, **arguments):
    return server.good(command, **arguments)


def expect(got, wanted):
    assert got == wanted, f"got {got!r}, expected {wanted!r}"


def top():
    frame = good("stackTrace", threadId=1)["stackFrames"][0]
    return frame["name"], frame["line"]


def value(expression):
    return good("evaluate", expression=expression, context="watch")["result"]


abilities = good("initialize", adapterID="twinpuck")
assert all(abilities[a] for a in ("supportsStepBack", "supportsReadMemoryRequest", "supportsDisassembleRequest", "supportsInstructionBreakpoints"))
assert not ask("stackTrace", threadId=1)["success"]
good("launch", world="maze", firmware=FIRMWARE, seconds=0.03)
event("initialized")
lines = {text.split("//")[1].strip(): n for n, text in enumerate(open(SOURCE, encoding="utf-8"), 1) if "//" in text}
set_points = good("setBreakpoints", source={"path": SOURCE},
                  breakpoints=[{"line": lines["toggle"], "condition": "ticks == 3"}, {"line": 9999}])["breakpoints"]
expect([b["verified"] for b in set_points], [True, False])
expect(set_points[0]["line"], lines["toggle"])
good("setExceptionBreakpoints", filters=[])
good("configurationDone")
stopped = event("stopped")
expect((stopped["reason"], stopped["hitBreakpointIds"]), ("breakpoint", [set_points[0]["id"]]))
expect(top(), ("work", lines["toggle"]))
expect([f["name"] for f in good("stackTrace", threadId=1)["stackFrames"]][:2], ["work", "main"])
expect(good("stackTrace", threadId=1)["stackFrames"][0]["source"]["path"], SOURCE)
expect(good("threads")["threads"], [{"id": 1, "name": "puck"}])
expect([s["name"] for s in good("scopes", frameId=0)["scopes"]], ["Variables", "Registers", "Peripherals"])
shown = {v["name"]: v["value"] for v in good("variables", variablesReference=2)["variables"]}
# main(), which called work(n), has its own
of_main = good("scopes", frameId=1)["scopes"][0]["variablesReference"]
callers = {v["name"]: v["value"] for v in good("variables", variablesReference=of_main)["variables"]}
assert "n" in shown and "n" not in callers and "now" in callers and "now" not in shown, (shown, callers)
expect(good("evaluate", expression="now", frameId=1, context="watch")["result"], callers["now"])
assert not ask("evaluate", expression="now", frameId=0, context="watch")["success"]
expect(shown["ticks"], "3 (0x3)")
assert "w15" in {v["name"] for v in good("variables", variablesReference=1)["variables"]}
pin = "LATA.LATA6"
assert "LATA" in {v["name"] for v in good("variables", variablesReference=3)["variables"]}
before = value(pin)
good("next", threadId=1)
expect(event("stopped")["reason"], "step")
assert value(pin) != before
good("stepBack", threadId=1)
event("stopped")
expect((top(), value(pin)), (("work", lines["toggle"]), before))
cycle, pc = value("cycle"), value("pc")
good("stepIn", threadId=1, granularity="instruction")
event("stopped")
assert value("pc") != pc and value("cycle") != cycle
good("stepBack", threadId=1, granularity="instruction")
event("stopped")
expect((value("cycle"), value("pc")), (cycle, pc))
good("stepOut", threadId=1)
event("stopped")
expect(top()[0], "main")

# memory and instructions
memory = {v["name"]: v.get("memoryReference") for v in good("variables", variablesReference=2)["variables"]}
expect(good("evaluate", expression="ticks", context="watch")["memoryReference"], memory["ticks"])
expect(good("evaluate", expression="&ticks", context="watch")["memoryReference"], memory["ticks"])
read = good("readMemory", memoryReference=memory["ticks"], count=2)
expect((int(read["address"], 16), base64.b64decode(read["data"])), (int(memory["ticks"], 16), b"\3\0"))
table = memory["ticks"]
expect(base64.b64decode(good("readMemory", memoryReference=table, offset=1, count=1)["data"]), b"\0")
expect(good("readMemory", memoryReference=table, count=0)["data"], "")
assert not ask("readMemory", memoryReference="here", count=2)["success"]
assert not ask("readMemory", memoryReference=table, count=-1)["success"]
frame = good("stackTrace", threadId=1)["stackFrames"][0]["instructionPointerReference"]
end = good("readMemory", memoryReference="0xfff0", count=64)
expect((len(base64.b64decode(end["data"])), end["unreadableBytes"]), (16, 48))
shown = good("disassemble", memoryReference=frame, instructionOffset=-20, instructionCount=50)["instructions"]
expect(len(shown), 50)
expect(int(shown[20]["address"], 16), int(frame, 16))
addresses = [int(one["address"], 16) for one in shown]
assert all(2 <= b - a <= 4 for a, b in zip(addresses, addresses[1:])), addresses
assert all(one["instruction"] for one in shown), shown
assert any(one.get("symbol") == "main" for one in good("disassemble", memoryReference=frame, instructionOffset=0, instructionCount=300)["instructions"]) or \
    any(one.get("symbol") == "main" for one in good("disassemble", memoryReference=frame, instructionOffset=-300, instructionCount=300)["instructions"])
assert {one["line"] for one in shown if "line" in one} >= {lines["toggle"]}, shown
assert all(one["location"]["path"] == SOURCE for one in shown if one.get("line") == lines["toggle"]), shown
expect(good("disassemble", memoryReference=frame, offset=addresses[21] - addresses[20], instructionCount=1)["instructions"][0]["address"], shown[21]["address"])
# at both ends of memory there are as many as were asked for
expect(len(good("disassemble", memoryReference="0x0", instructionOffset=-5, instructionCount=10)["instructions"]), 10)
expect(len(good("disassemble", memoryReference="0x17ffc", instructionOffset=0, instructionCount=10)["instructions"]), 10)
at = next(one["address"] for one in shown[21:] if one.get("line", lines["toggle"]) == lines["toggle"])
expect([b["verified"] for b in good("setInstructionBreakpoints", breakpoints=[{"instructionReference": at}, {"instructionReference": "0x3"}])["breakpoints"]], [True, False])
good("setInstructionBreakpoints", breakpoints=[])

# changed by hand, watched, the monitor's commands
expect(good("setVariable", variablesReference=2, name="ticks", value="10 + 1")["value"], "11")
assert not ask("setVariable", variablesReference=2, name="nothing", value="1")["success"]
assert not ask("evaluate", expression="nothing", context="watch")["success"]
assert "it goes round in main()" in good("evaluate", expression="why", context="repl")["result"]
good("setBreakpoints", source={"path": SOURCE}, breakpoints=[])
expect(good("dataBreakpointInfo", name="ticks")["dataId"], "ticks")
good("setDataBreakpoints", breakpoints=[{"dataId": "ticks"}])
good("continue", threadId=1)
stopped = event("stopped")
expect(stopped["reason"], "data breakpoint")
assert "ticks: 11 -> 12, by _T1Interrupt()" in stopped["text"], stopped
assert top()[0] == "_T1Interrupt (interrupt)"
good("setDataBreakpoints", breakpoints=[])
expect([b["verified"] for b in good("setFunctionBreakpoints", breakpoints=[{"name": "work"}, {"name": "no"}])["breakpoints"]],
       [True, False])
good("continue", threadId=1)
expect((event("stopped")["reason"], top()[0]), ("breakpoint", "work"))
good("reverseContinue", threadId=1)
expect((event("stopped")["reason"], top()[0]), ("breakpoint", "work"))
good("setFunctionBreakpoints", breakpoints=[])
assert not ask("launchRockets")["success"]
assert not ask("setBreakpoints", source={"path": 1})["success"]

# a pause, and a breakpoint that is set while it runs; then the end of the world's time
good("continue", threadId=1)
good("setFunctionBreakpoints", breakpoints=[])
event("terminated")
good("disconnect")
expect(server.process.wait(10), 0)

# another one, paused while it runs
server = Server(TWINPUCK)
good("initialize", adapterID="twinpuck")
assert not ask("launch", world="nowhere")["success"]
event("terminated")
assert "expected sim, dspic" in ask("launch", hal="boat")["message"]
event("terminated")
assert "native is hal sim now" in ask("launch", way="native")["message"]
event("terminated")
for wrong, says in (({"seed": -1}, "launch: seed: got -1, expected 0 to 18446744073709551615"),
                    ({"seed": 1.5}, "launch: seed: got 1.5, expected 0 to 18446744073709551615"),
                    ({"seconds": -1}, "launch: seconds: got -1, expected 0 to 1e+07 s"),
                    ({"seconds": "x"}, "launch: seconds: got \"x\", expected 0 to 1e+07 s")):
    expect(ask("launch", firmware=FIRMWARE, **wrong)["message"], says)
    event("terminated")
good("launch", firmware=FIRMWARE, stopOnEntry=True)
event("initialized")
good("configurationDone")
expect(event("stopped")["reason"], "entry")
expect(ask("launch", firmware=FIRMWARE)["message"], "launch: got a second one, expected one a session")
expect(good("setInstructionBreakpoints", breakpoints=[{"instructionReference": "zz"}])["breakpoints"],
       [{"verified": False, "message": "got 'zz', expected an address such as 0x1a0"}])
for command, more in (("variables", {}), ("setVariable", {"name": "ticks", "value": "7"})):
    expect(ask(command, variablesReference=99999, **more)["message"], "variablesReference: got none of scopes")
good("continue", threadId=1)
good("threads")
for line in ("why", "break main", "info registers"):
    expect(ask("evaluate", expression=line, context="repl")["message"], f"'{line}': the program runs; pause it first")
assert good("evaluate", expression="1 + 1", context="repl")["result"].startswith("2")
good("pause", threadId=1)
expect(event("stopped")["reason"], "pause")
assert int(value("cycle").split()[0]) > 0
good("disconnect")
expect(server.process.wait(10), 0)

# one that counts from 0, whose ids are looked at
server = Server(TWINPUCK)
good("initialize", adapterID="twinpuck", linesStartAt1=False, columnsStartAt1=False)
good("launch", firmware=FIRMWARE)
expect(good("setBreakpoints", source={"path": SOURCE}, breakpoints=[{"line": lines["toggle"] - 1}])["breakpoints"][0]["line"], lines["toggle"] - 1)
good("configurationDone")
event("stopped")
frames = good("stackTrace", threadId=1)["stackFrames"]
expect((frames[0]["line"], frames[0]["column"]), (lines["toggle"] - 1, 0))
pc = frames[0]["instructionPointerReference"]
expect(good("disassemble", memoryReference=pc, instructionCount=1)["instructions"][0]["line"], lines["toggle"] - 1)
for command, more, says in (("stackTrace", {"threadId": 7}, "threadId: got 7, expected 1, the robot's program"),
                            ("continue", {"threadId": "x"}, "threadId: got \"x\", expected 1, the robot's program"),
                            ("scopes", {"frameId": len(frames)}, f"frameId: got {len(frames)}, expected 0 to {len(frames) - 1}, as stackTrace has them"),
                            ("evaluate", {"frameId": -1, "expression": "ticks"}, f"frameId: got -1, expected 0 to {len(frames) - 1}, as stackTrace has them")):
    expect(ask(command, **more)["message"], says)
good("disconnect")
expect(server.process.wait(10), 0)

# a world in which nobody has a program
server = Server(TWINPUCK)
with tempfile.TemporaryDirectory() as folder:
    world = pathlib.Path(folder, "bare.toml")
    world.write_text('twinpuck = 1\n[[robot]]\nname = "puck"\n', encoding="utf-8")
    expect(ask("launch", world=str(world))["message"],
           "debug: firmware: got none, and none in the world, expected a program for a robot; --fw, or launch's firmware, gives it one")
good("disconnect")

# what is no message ends it, with what came
HEADER = "dap: header: got %s, expected Content-Length: N, of 16777216 bytes at most, and an empty line; is it an editor that speaks?\n"
OTHER = "dap: message: got something else, expected an object with seq and command\n"
for wrong, says in ((b"Content-Length: 5\r\n\r\n[[[[[", OTHER), (b"Content-Length: 2\r\n\r\n[]", OTHER),
                    (b"Content-Length: 5\r\n\r\n{", "dap: message: got 1 bytes and then nothing more, expected 5\n"),
                    (b"Garbage\r\n\r\n", HEADER % "'Garbage'"), (b"Content-Length: -1\r\n\r\n", HEADER % "'Content-Length: -1'"),
                    (b"Content-Length: 99999999\r\n\r\n", HEADER % "'Content-Length: 99999999'"),
                    (b"\1\2 no header", HEADER % "'\\x01\\x02 no header' and then nothing more"),
                    (b"X" * 5_000_000, HEADER % "more than 4096 bytes of others")):
    done = subprocess.run([TWINPUCK, "debug", "--dap"], input=wrong, capture_output=True, timeout=10, check=False)
    expect((done.returncode, done.stderr.decode()), (2, says))
print("all as expected")
