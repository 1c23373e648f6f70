// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { FakeLink, freshDocument, refuse, settle } from "./dom";
import { Console } from "../src/panes/console";
import { Inspector } from "../src/panes/inspector";
import { ProblemsPane } from "../src/panes/problems";
import { Tree } from "../src/panes/tree";
import { Client } from "../src/store/client";
import { Pieces } from "../src/store/pieces";
import { findingOf, placeIn, wrongsOf } from "../src/store/problems";
import { Store } from "../src/store/store";
import { drive, element, robot, thing, world } from "./worlds";

function start() {
  freshDocument();
  const store = new Store(),
    link = new FakeLink(),
    client = new Client(store, link),
    pieces = new Pieces(store, client);
  store.schema = {
    proximity: {
      many: false,
      doc: "Sensors.",
      keys: [{ key: "rays", type: "integer", unit: "", default: "", doc: "How many" }],
    },
    box: {
      many: true,
      doc: "A box.",
      keys: [{ key: "size", type: "triple", unit: "m", default: "", doc: "Its size" }],
    },
  };
  return { store, link, client, pieces };
}
const text = (selector: string) => document.querySelector(selector)!.textContent!;

test("Problems never says that nothing is wrong when something is", () => {
  const { store } = start();
  document.getElementById("dock")!.innerHTML = '<button id="tab-problems"></button>';
  const pane = new ProblemsPane(store).pane;
  const runs = { ...store.state, runs: true };
  store.takeWorld(world(), 1);
  store.takeState(runs);
  assert.equal(pane.textContent, "Nothing is wrong.");
  store.takeState({ ...runs, runs: false });
  assert.match(pane.textContent!, /There is no run/);
  store.noRun = ["robot puck: two robots of that name"];
  store.tell("problems");
  assert.match(pane.textContent!, /No run: robot puck/);
  store.noRun = [];
  store.takeState({ ...runs, recording: { file: "r.jsonl", error: "no space left" } });
  assert.match(pane.textContent!, /r\.jsonl: no space left/);
  store.takeState(runs);
  const program = { name: "drive", robots: ["puck"], folder: "/w/drive", files: ["main.c"] };
  store.takePrograms([{ ...program, built: true, ok: false, findings: [] }]);
  assert.match(pane.textContent!, /drive was not built/);
  store.takePrograms([
    {
      ...program,
      built: true,
      ok: false,
      findings: [findingOf("main.c:3:5: error: no such thing", "error", ["main.c"])],
    },
  ]);
  const went: unknown[] = [];
  store.on("sourceLine", (at) => went.push(at));
  pane.querySelector("button")!.click();
  assert.deepEqual(went, [{ program: "drive", file: "main.c", line: 3, column: 5 }]);
  assert.equal(document.getElementById("tab-problems")!.dataset.count, "1");
});

test("what a compiler says has its place, and so have traps", () => {
  assert.deepEqual(findingOf("/w/drive/main.c:3:5: warning: unused", "warning", ["main.c"]), {
    kind: "warning",
    file: "main.c",
    line: 3,
    column: 5,
    text: "unused",
  });
  // [told, file, line, column, text]
  for (const [told, ...expected] of [
    ["nothing to build", "", 0, 0, "nothing to build"],
    ["main.c:3: no column", "main.c", 3, 0, "no column"],
    ["sub/a.c:3:5: fatal error: gone", "a.c", 3, 5, "gone"],
    ["b.c:1:2: note: of another file", "b.c", 1, 2, "of another file"],
    ["main.c:9:1: error: two\nlines", "main.c", 9, 1, "two\nlines"],
  ] as [string, ...unknown[]][]) {
    const f = findingOf(told, "error", ["main.c", "a.c"]);
    assert.deepEqual([f.file, f.line, f.column, f.text], expected);
  }
  const programs = [drive("main.c", "sub/a.c")];
  assert.deepEqual(placeIn(programs, "puck", "turn() (sub/a.c:7)"), { program: "drive", file: "sub/a.c", line: 7 });
  assert.equal(placeIn(programs, "other", "main() (main.c:7)"), undefined);
  const { store } = start();
  store.takeWorld(world({ problems: [{ line: 4, column: 1, text: "size: too small", id: 9 }] }), 1);
  store.noRun = ["world.toml:4:1: size: too small"];
  store.takeState({ ...store.state, runs: false });
  assert.deepEqual(
    wrongsOf(store).map((w) => w.of),
    ["world"],
  );
});

test("what Problems lists, each from where it is known", () => {
  const built = drive("main.c");
  const at = { robot: "puck", place: "main() (main.c:7)", time_s: 1.5 };
  const rows: [string, (store: Store) => void, string[]][] = [
    ["nobody has said anything yet", (s) => (s.revision = 0), []],
    ["a world and no run", () => {}, ["run error: There is no run."]],
    ["why there is none", (s) => (s.noRun = ["no robot"]), ["run error: No run: no robot"]],
    ["a page that is a report has none", (s) => (s.recorded = true), []],
    ["was not built", (s) => s.takePrograms([{ ...built, ok: false }]), ["compiler error: drive was not built"]],
    [
      "is not built yet",
      (s) => s.takePrograms([{ ...built, built: false, ok: false }]),
      ["run error: There is no run."],
    ],
    [
      "no line, a line without a column, and a file that is not the program's: one alone can be gone to",
      (s) =>
        s.takePrograms([
          {
            ...built,
            findings: [
              { kind: "error", file: "a.c", line: 0, column: 0, text: "gone" },
              { kind: "warning", file: "main.c", line: 4, column: 0, text: "odd" },
              { kind: "note", file: "e_led.h", line: 5, column: 2, text: "here" },
              { kind: "note", file: "main.c", line: 0, column: 0, text: "in all" },
            ],
          },
        ]),
      [
        "compiler error: drive: a.c: gone",
        "compiler warning: drive: main.c:4: odd > main.c:4:0",
        "compiler note: drive: e_led.h:5:2: here",
        "compiler note: drive: main.c: in all",
      ],
    ],
    [
      "a trap, and what was found out",
      (s) => {
        s.takePrograms([built]);
        s.traps = [{ ...at, kind: "math error", text: "divided", file: "", line: 0 }];
        s.diagnoses = [{ ...at, cause: "stack", text: "deep", hint: "less" } as never];
      },
      [
        "trap error: puck: math error: divided, at main() (main.c:7), 1.500 s > main.c:7:",
        "diagnosis warning: puck: stack at main() (main.c:7), 1.500 s: deep; less > main.c:7:",
      ],
    ],
  ];
  for (const [what, make, expected] of rows) {
    const { store } = start();
    store.takeWorld(world(), 1);
    make(store);
    assert.deepEqual(
      wrongsOf(store)
        .filter((w) => expected.length < 2 || w.of !== "run")
        .map(
          ({ of, weight, text, source: to }) =>
            `${of} ${weight}: ${text}${to ? ` > ${to.file}:${to.line}:${to.column ?? ""}` : ""}`,
        ),
      expected,
      what,
    );
  }
});

test("the console puts a character together and shows the rest of one that does not come", () => {
  const { store, client } = start();
  document.body.append(new Console(store, client).pane);
  const hear = (bytes: string, time_s: number) => store.tell("serial", { robot: "puck", port: 1, text: bytes, time_s });
  hear("caf\xc3", 1);
  hear("\xa9\x80\r\n", 1.01);
  hear("\xe2\x82", 2);
  hear("next\n", 3);
  const lines = [...document.querySelectorAll("#console-lines > div")].map((l) => l.querySelector("span")!.textContent);
  assert.deepEqual(lines, ["café\\x80", "\\xe2\\x82next"]);
});

test("the inspector adds a section that the file does not have", async () => {
  const { store, link, client, pieces } = start();
  new Inspector(store, client, pieces);
  store.takeWorld(world(), 1);
  const input = document.querySelector<HTMLInputElement>("[data-section=proximity][data-key=rays]")!;
  assert.match(text("details.section summary"), /not in the file/);
  input.value = "4";
  input.dispatchEvent(new Event("change"));
  assert.deepEqual(link.of("edit"), [{ op: "add", path: "proximity", values: { rays: 4 } }]);
  store.takeWorld(world({ elements: [element(7, "proximity", 3, { rays: "4" })] }), 2);
  const written = document.querySelector<HTMLInputElement>("[data-section=proximity][data-key=rays]")!;
  assert.equal(written.value, "4");
  written.value = "";
  written.dispatchEvent(new Event("change"));
  assert.deepEqual(link.of("edit")[1], { op: "set", thing: 7, values: { rays: null }, group: 0 });
  await settle();
});

test("several pieces are changed by one request", async () => {
  const { store, link, pieces } = start();
  store.takeWorld(
    world({
      things: [
        thing(1, { position: [0.1, 0.2], heading: 0 }),
        thing(2, {
          kind: "wall",
          points: [
            [0, 0],
            [1, 0],
          ] as never,
        }),
      ],
    }),
    1,
  );
  store.selectAll([1, 2]);
  pieces.nudge(1, 0, 0.01);
  await settle();
  const { edits, group } = link.of("edit")[0];
  assert.ok(group > 0);
  assert.deepEqual(edits, [
    { op: "set", thing: 1, values: { position: [0.11, 0.2] } },
    {
      op: "set",
      thing: 2,
      values: {
        points: [
          [0.01, 0],
          [1.01, 0],
        ],
      },
    },
  ]);
  link.answers.edit = () => ({ things: [5, 0] });
  store.takeWorld(world({ things: [thing(1), thing(5)] }), 2);
  store.selectAll([1, 5]);
  await pieces.copy();
  assert.deepEqual(store.selection, [5]);
});

test("a run is lost only when somebody says so", async () => {
  const { link, client } = start();
  let times = 0;
  link.answers.edit = (more) => (
    ++times,
    more.anew ? { thing: 3 } : refuse("robots come and go only when a run begins", { anew: true })
  );
  const asked = client.edit({ op: "remove", thing: 1 });
  await settle();
  document.getElementById("leave")!.click();
  assert.equal(await asked, undefined);
  const again = client.edit({ op: "remove", thing: 1 });
  await settle();
  document.getElementById("anew")!.click();
  assert.deepEqual(await again, { thing: 3 });
  assert.equal(times, 3);
});

test("the list of pieces follows the world and keeps its rows", () => {
  const { store, pieces } = start();
  new Tree(store, pieces);
  const elements = [element(1, "box", 4), element(2, "robot", 9)];
  store.takeWorld(world({ things: [thing(1, { name: "wall" })], robots: [robot(2)], elements }), 1);
  const rows = () => [...document.querySelectorAll<HTMLElement>("#pieces li")];
  assert.deepEqual(
    rows().map((r) => r.textContent),
    ["puck · drive0.00 0.00 m:9", "wall · box0.00 0.00 m:4"],
  );
  const [puck] = rows();
  store.takeWorld(world({ things: [thing(1, { name: "wall", position: [1, 0] })], robots: [robot(2)], elements }), 2);
  assert.equal(rows()[0], puck);
  assert.match(rows()[1].textContent!, /1\.00 0\.00 m/);
  puck.click();
  assert.equal(store.selected, 2);
  assert.equal(puck.getAttribute("aria-selected"), "true");
});

test("the list of pieces is walked by keys and picked by mouse", () => {
  const { store, pieces } = start();
  new Tree(store, pieces);
  const elements = [1, 2, 3, 4].map((id) => element(id, "box", 10 * id));
  store.takeWorld(world({ things: [1, 2, 3, 4].map((id) => thing(id)), elements }), 1);
  const list = document.getElementById("pieces")!,
    row = (id: number) => document.getElementById(`piece-${id}`)!;
  const lines: number[] = [];
  store.on("worldLine", (line) => lines.push(line as number));
  const press = (key: string, more: object = {}) => {
    const e = new KeyboardEvent("keydown", { key, cancelable: true, ...more });
    list.dispatchEvent(e);
    return e.defaultPrevented;
  };
  const click = (id: number, more: object = {}) => row(id).dispatchEvent(new MouseEvent("click", more));
  // key by key: what is selected then, the last one first asked for
  const steps: [string, object, number[]][] = [
    ["ArrowUp", {}, [1]],
    ["ArrowDown", {}, [2]],
    ["ArrowUp", {}, [1]],
    ["ArrowUp", {}, [1]],
    ["End", {}, [4]],
    ["ArrowDown", {}, [4]],
    ["Home", {}, [1]],
    ["ArrowDown", { shiftKey: true }, [1, 2]],
    ["ArrowDown", { shiftKey: true }, [1, 2, 3]],
    ["a", { ctrlKey: true }, [1, 2, 3, 4]],
  ];
  for (const [key, more, selected] of steps) {
    assert.equal(press(key, more), true);
    assert.deepEqual(store.selection, selected, key);
  }
  assert.equal(press("a"), false);
  click(2);
  assert.deepEqual(store.selection, [2]);
  click(4, { ctrlKey: true });
  assert.deepEqual(store.selection, [2, 4]);
  click(2, { metaKey: true });
  assert.deepEqual(store.selection, [4]);
  click(3, { shiftKey: true });
  assert.deepEqual(store.selection, [2, 3]);
  assert.equal(row(3).getAttribute("aria-selected"), "true");
  assert.equal(row(4).getAttribute("aria-selected"), "false");
  assert.equal(list.getAttribute("aria-activedescendant"), "piece-3");
  assert.equal(press("Enter"), true);
  row(4).dispatchEvent(new MouseEvent("dblclick"));
  assert.deepEqual(lines, [30, 40]);
});

test("the list of pieces shows what the filter holds", () => {
  const { store, pieces } = start();
  new Tree(store, pieces);
  const things = [thing(1, { name: "wall" }), thing(2, { name: "crate", kind: "cylinder" })];
  store.takeWorld(world({ things, robots: [robot(3)] }), 1);
  const filter = document.getElementById("piece-filter") as HTMLInputElement;
  const shown = (wanted: string) => {
    filter.value = wanted;
    filter.dispatchEvent(new Event("input"));
    return [...document.querySelectorAll<HTMLElement>("#pieces li")].map((r) => r.id);
  };
  assert.deepEqual(shown(" WALL "), ["piece-1"]);
  assert.deepEqual(shown("cyl"), ["piece-2"]);
  assert.deepEqual(shown("driv"), ["piece-3"]);
  assert.equal(text("#tree small"), "1 of 3");
  assert.deepEqual(shown(""), ["piece-3", "piece-1", "piece-2"]);
  assert.equal(text("#tree small"), "3");
});
