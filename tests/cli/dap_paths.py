# SPDX-License-Identifier: MIT
"""An editor that opens a file and sets breakpoints in it: dap_paths.py TWINPUCK FIRMWARE SOURCE [--any-line | --stranger]."""
import json
import subprocess
import sys

TWINPUCK, FIRMWARE, SOURCE, *OPTIONS = sys.argv[1:]
server = subprocess.Popen([TWINPUCK, "debug", "--dap"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
sequence = 0
events = []


def receive():
    length = 0
    while (line := server.stdout.readline().strip()):
        length = int(line.split(b":")[1])
    assert length > 0, "the server has ended"
    return json.loads(server.stdout.read(length))


def ask(command, **arguments):
    global sequence
    sequence += 1
    text = json.dumps({"seq": sequence, "type": "request", "command": command, "arguments": arguments}).encode()
    server.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(text), text))
    server.stdin.flush()
    while (message := receive())["type"] == "event":
        events.append(message)
    assert message["success"], message
    return message.get("body", {})


def event(name):
    while True:
        for e in events:
            if e["event"] == name:
                events.remove(e)
                return e.get("body", {})
        events.append(receive())


ask("initialize", adapterID="twinpuck")
ask("launch", world="maze", firmware=FIRMWARE, seconds=1)
event("initialized")
lines = open(SOURCE, encoding="utf-8").read().split("\n")
if "--any-line" in OPTIONS:
    line = next(n for n, text in enumerate(lines, 1) if text.startswith("int main")) + 3
else:
    line = next(n for n, text in enumerate(lines, 1) if "// toggle" in text)
points = ask("setBreakpoints", source={"path": SOURCE}, breakpoints=[{"line": line}])["breakpoints"]
if "--stranger" in OPTIONS:
    assert [p["verified"] for p in points] == [False], points
else:
    assert [p["verified"] for p in points] == [True], points
    ask("configurationDone")
    assert event("stopped")["reason"] == "breakpoint"
    top = ask("stackTrace", threadId=1)["stackFrames"][0]
    assert top["source"]["path"] == SOURCE, top
    assert top["line"] == points[0]["line"], top
ask("disconnect")
server.wait(10)
print("all as expected")
