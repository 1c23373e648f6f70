// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { FakeLink, freshDocument, refuse, settle } from "./dom";
import { h } from "../src/dom";
import { DebuggerPane } from "../src/panes/debugger";
import { keyOf } from "../src/store/buffer";
import { Client } from "../src/store/client";
import { Debugging } from "../src/store/debugging";
import { Store } from "../src/store/store";
import { drive, robot, world } from "./worlds";

const kMain = keyOf("drive", "main.c");

function start() {
  freshDocument();
  const store = new Store(),
    link = new FakeLink(),
    client = new Client(store, link),
    debug = new Debugging(store, client);
  let ticks = 1;
  link.answers.debug = () => ({ ok: true });
  link.answers.dap = ({ message }) => {
    const more = message.arguments;
    const bodies: Record<string, () => unknown> = {
      setBreakpoints: () => ({
        breakpoints: more.breakpoints.map((b: any) =>
          b.line === 99 ? { verified: false, message: "no code there" } : { verified: true, id: b.line },
        ),
      }),
      stackTrace: () => ({
        stackFrames: [
          { id: 0, name: "turn", line: 12, source: { name: "main.c", path: "/w/drive/main.c" } },
          { id: 1, name: "main", line: 30, source: { name: "main.c", path: "/w/drive/main.c" } },
          { id: 2, name: "0x000200", line: 0, instructionPointerReference: "0x200" },
        ],
      }),
      scopes: () => ({
        scopes: [
          { name: "Variables", variablesReference: 1, expensive: false },
          { name: "Peripherals", variablesReference: 3, expensive: true },
        ],
      }),
      variables: () => ({
        variables:
          more.variablesReference === 1
            ? [{ name: "ticks", value: String(ticks++) }]
            : [{ name: "T1CON", value: "0x8000" }],
      }),
      setVariable: () => ({ value: more.value }),
      evaluate: () =>
        more.expression === "nonsense"
          ? refuse("nonsense is nothing")
          : { result: more.expression === "why" ? "it waits" : "7" },
      dataBreakpointInfo: () => ({ dataId: more.name, description: more.name }),
    };
    return { body: bodies[message.command]?.() ?? {} };
  };
  store.takeWorld(world({ robots: [robot(1)] }), 1);
  store.takePrograms([drive("main.c")]);
  const commands = (name: string) => link.of("dap").filter((m) => m.message.command === name);
  return { store, link, debug, commands };
}

test("breakpoints are kept by file, sent when a robot is debugged, and told whether they can be met", async () => {
  const { store, debug, commands } = start();
  debug.toggle(kMain, 12);
  debug.condition(kMain, 30, "ticks > 3");
  debug.toggle(kMain, 99);
  assert.equal(commands("setBreakpoints").length, 0);
  await debug.start("puck");
  await settle();
  const sent = commands("setBreakpoints")[0].message.arguments;
  assert.equal(sent.source.path, "/w/drive/main.c");
  assert.deepEqual(sent.breakpoints, [{ line: 12 }, { line: 30, condition: "ticks > 3" }, { line: 99 }]);
  assert.deepEqual(
    debug.of(kMain).map((b) => b.verified),
    [true, true, false],
  );
  debug.toggle(kMain, 12);
  debug.moved(kMain, [31, 100]);
  const again = new Debugging(store, new Client(store, new FakeLink()));
  assert.deepEqual(
    again.of(kMain).map((b) => [b.line, b.condition]),
    [
      [31, "ticks > 3"],
      [100, ""],
    ],
  );
});

test("where it stands is shown, and what has changed since", async () => {
  const { store, link, debug, commands } = start();
  const went: unknown[] = [];
  store.on("sourceLine", (at) => went.push(at));
  await debug.start("puck");
  await settle();
  await debug.watch("motors[1]");
  await debug.watch("nonsense");
  link.event("dap", { name: "stopped", body: { reason: "breakpoint", hitBreakpointIds: [12] } });
  await settle();
  assert.ok(debug.stands);
  assert.equal(debug.reason, "breakpoint 12");
  assert.deepEqual(
    debug.calls.map((c) => c.place),
    ["main.c:12", "main.c:30", "0x200"],
  );
  assert.deepEqual(went.pop(), { program: "drive", file: "main.c", line: 12 });
  assert.equal(debug.line(kMain), 12);
  assert.deepEqual(debug.scopes[0].variables, [{ name: "ticks", value: "2", reference: 1, changed: true }]);
  assert.equal(debug.scopes[1].variables, undefined); // nobody looks
  assert.deepEqual(
    debug.watches.map((w) => [w.value, w.wrong]),
    [
      ["7", false],
      ["nonsense is nothing", true],
    ],
  );
  debug.goTo(1);
  assert.equal(debug.line(kMain), 30);
  await debug.unfold(debug.scopes[1], true);
  assert.equal(debug.scopes[1].variables![0].value, "0x8000");
  await debug.set(debug.scopes[0].variables![0], "9");
  assert.equal(debug.scopes[0].variables![0].value, "9");
  await debug.stopAt(debug.watches[0], true);
  assert.deepEqual(commands("setDataBreakpoints")[0].message.arguments.breakpoints, [
    { dataId: "motors[1]", accessType: "write" },
  ]);
  await debug.step("stepBack");
  assert.equal(debug.line(kMain), 0);
  assert.equal(commands("stepBack").length, 1);
  await debug.monitor("why");
  assert.deepEqual(debug.output.slice(-2), ["> why", "it waits"]);
});

test("what belongs to a debugged robot goes with it, and what is kept stays", async () => {
  const { store, debug, commands } = start();
  debug.toggle(kMain, 30);
  debug.toggle(kMain, 12);
  await debug.start("puck");
  await settle();
  assert.deepEqual(
    debug.of(kMain).map((b) => [b.line, b.verified]),
    [
      [12, true],
      [30, true],
    ],
  );
  // lines of another list, or the same ones: nothing has moved
  const told: unknown[] = [];
  store.on("breakpoints", (key) => told.push(key));
  debug.moved(kMain, [13]);
  debug.moved(kMain, [12, 30]);
  debug.moved(kMain, [13, 31, 40]);
  assert.deepEqual(told, []);
  // two that have come to the same line are one
  debug.moved(kMain, [13, 13]);
  assert.deepEqual(
    debug.of(kMain).map((b) => b.line),
    [13],
  );
  await debug.watch("motors[1]");
  await debug.watch("motors[1]");
  await debug.watch("");
  assert.equal(debug.watches.length, 1);
  await debug.stopAt(debug.watches[0], true);
  debug.unwatch(debug.watches[0]);
  await settle();
  assert.deepEqual(
    commands("setDataBreakpoints").map((m) => m.message.arguments.breakpoints.length),
    [1, 0],
  );
  await debug.end();
  assert.deepEqual(
    debug.of(kMain).map((b) => [b.line, b.verified]),
    [[13, undefined]],
  );
  assert.deepEqual([debug.stands, debug.calls, debug.scopes, debug.reason], [false, [], [], ""]);
});

test("the debugger's output keeps its last 400 lines", async () => {
  const { link, debug } = start();
  for (let i = 0; i < 201; ++i) link.event("dap", { name: "output", body: { output: `${i} a\n${i} b\n` } });
  assert.equal(debug.output.length, 400);
  assert.deepEqual([debug.output[0], debug.output[399]], ["1 a", "200 b"]);
  link.event("dap", { name: "terminated" });
  assert.equal(debug.output[399], "The run has ended.");
});

test("the pane has a button for what can be done now", async () => {
  const { store, debug } = start();
  const made = new DebuggerPane(store, debug),
    pane = h("div", {}, made.begin, made.pane);
  document.body.append(pane);
  const button = (id: string) => pane.querySelector<HTMLButtonElement>(`#debug-${id}`)!;
  assert.equal(button("begin").textContent, "Debug puck");
  assert.ok(button("next").disabled);
  button("begin").click();
  await settle();
  await settle();
  assert.ok(!button("next").disabled);
  assert.ok(button("pause").disabled);
  assert.equal(pane.querySelectorAll("#debug-calls button").length, 3);
  assert.equal(button("begin").textContent, "End debugging puck");
  button("continue").click();
  assert.ok(button("next").disabled);
  assert.ok(!button("pause").disabled);
  // somebody else ends it
  store.takeState({ ...store.state, debugging: "" });
  assert.equal(debug.debugged, "");
});
