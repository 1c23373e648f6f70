# SPDX-License-Identifier: MIT
"""An editor that opens a file and sets breakpoints in it: dap_paths.py TWINPUCK FIRMWARE SOURCE [--any-line | --stranger]."""
import sys

from dap import Server

TWINPUCK, FIRMWARE, SOURCE, *OPTIONS = sys.argv[1:]
server = Server(TWINPUCK)
ask, event = server.good, server.event

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
server.process.wait(10)
print("all as expected")
