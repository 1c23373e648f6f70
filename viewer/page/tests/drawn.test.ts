// SPDX-License-Identifier: MIT
// What is drawn by hand: a robot's senses, the time line.
import assert from "node:assert/strict";
import test from "node:test";
import { FakeLink, freshDocument } from "./dom";
import { Pen } from "./pen";
import { TimeLine } from "../src/panes/timeline";
import type { TraceEvent } from "../src/panes/timeline";
import { drawEars, drawFan } from "../src/panes/senses";
import { lineColour } from "../src/store/colours";
import { Client } from "../src/store/client";
import { Store } from "../src/store/store";
import { robot, world } from "./worlds";

const near = (a: number, b: number, what = "") => assert.ok(Math.abs(a - b) < 0.05, `${what}: got ${a}, expected ${b}`);
const kColours = {
  accent: "#0000a1",
  good: "#00a100",
  line: "#111111",
  text: "#222222",
  panel2: "#333333",
  dim: "#444444",
};
function start() {
  freshDocument();
  for (const [name, colour] of Object.entries({ ...kColours, bad: "#a10000" }))
    document.documentElement.style.setProperty(`--${name}`, colour);
}

test("the fan: as far as the root of the counts, ahead is up, and each sensor's counts beside it", () => {
  start();
  const pen = new Pen({ width: 480, height: 460 });
  // ahead, to the left, and behind; in the robot's frame left is a quarter turn
  const sensors = [0, Math.PI / 2, Math.PI].map((angle) => [0, 0, 0, angle]) as never;
  const counts: Record<string, number> = { ir0: 4095, ir1: 1023.75, ir2: -3 };
  drawFan(pen.context, robot(1, { sensors }), 0b10000001, (name) => counts[name]);
  const [mx, my] = [240, 240];
  // each is filled between the body and its reach: 62 px for nothing, 185 px for 4095 counts, half way for a quarter
  const reaches = pen.of("fill", kColours.accent).map((d) => d.arcs);
  assert.equal(reaches.length, 3);
  reaches.forEach((arcs, i) => {
    const middle = -Math.PI / 2 - (i * Math.PI) / 2;
    near(arcs[0].r, [185, 62 + 123 / 2, 62][i], `reach of ${i}`);
    near(arcs[1].r, 62, "the body's side");
    near((arcs[0].from + arcs[0].to) / 2, middle, `side of ${i}`);
    near(arcs[0].to - arcs[0].from, 0.4, "width");
    assert.deepEqual([arcs[1].from, arcs[1].to], [arcs[0].to, arcs[0].from], "back along the body");
  });
  for (const d of pen.of("fill", kColours.line).slice(0, 3)) near(d.arcs[0].r, 185, "what there is to reach");
  const texts = pen.of("text");
  assert.deepEqual(
    texts.map((d) => d.text),
    ["4095", "1024", "-3"],
  );
  assert.ok(texts[0].points[0][1] < my - 185 && texts[1].points[0][0] < mx - 185 && texts[2].points[0][1] > my + 185);
  // LED 0 ahead and LED 7 to its left are on
  const lit = pen.of("fill", "#ff3b30");
  assert.equal(lit.length, 2);
  near(lit[0].arcs[0].x, mx);
  near(lit[0].arcs[0].y, my - 44);
  near(lit[1].arcs[0].x, mx - 44 * Math.SQRT1_2);
  // the body is a disc, and what shows where it looks a triangle of its own
  const [disc] = pen.of("fill", kColours.panel2);
  assert.deepEqual([disc.arcs.length, disc.points.length], [1, 0]);
  near(disc.arcs[0].r, 56);
  const [arrow] = pen.of("fill", kColours.text);
  assert.deepEqual([arrow.arcs.length, arrow.points.length], [0, 4]);
  assert.ok(arrow.points[0][1] < arrow.points[1][1], "it points ahead");
  assert.equal(pen.of("stroke", kColours.dim)[0].arcs.length, 1);
});

test("the ears: discs as large as it is loud, an arrow from where the sound comes", () => {
  start();
  const pen = new Pen({ width: 580, height: 220 });
  const at = (values: Record<string, number>) => (drawEars(pen.context, (name) => values[name]), pen);
  // nothing is heard: discs of the least size, and no arrow
  assert.deepEqual(
    at({ speaker: 25 })
      .of("fill", kColours.good)
      .map((d) => d.arcs[0]?.r),
    [5, 5, 5],
  );
  const bars = (name: string) => pen.of("rect", name).map((d) => d.points[0][2]);
  assert.deepEqual(
    [bars(kColours.line), bars(kColours.good), bars(kColours.accent)],
    [[170, 170, 170, 170], [0, 0, 0], [85]],
  );
  // 400 counts are as loud as it shows, the root of 400 * 0.3 is half as much
  at({ mic_level0: 4000, mic_level1: Math.sqrt(120), mic_level2: 0.1, sound_bearing: 90 });
  const marks = pen.of("fill", kColours.good);
  marks.slice(0, 3).forEach((d, i) => {
    near(d.arcs[0].r, [22, 13.5, 5][i], `microphone ${i}`);
    near(d.arcs[0].x, 120 + [60.3, -60.3, 0][i], "right, left, middle");
    near(d.arcs[0].y, 110 - [15.6, 15.6, -42.8][i], "ahead, ahead, behind");
    assert.equal(d.alpha, 0.75);
  });
  bars(kColours.good).forEach((wide, i) => near(wide, [170, 85, 0][i]));
  assert.deepEqual(
    pen.of("text").map((d) => d.text),
    ["right", "4000.0", "left", "11.0", "back", "0.1", "speaker", "0 %"],
  );
  // 90 degrees is from the left: the arrow lies there, its head towards the robot
  const head = marks[3].points;
  near(head[0][0], 120 - 78, "tip");
  near(head[0][1], 110, "tip");
  assert.ok(head[1][0] < head[0][0] && head[2][0] < head[0][0]);
  const [shaft] = pen.of("stroke", kColours.good);
  near(shaft.points[0][0], 120 - 116, "its end");
  near(shaft.points[1][0], 120 - 90, "its begin");
});

/** A time line of 1008 px, 800 of which are time, that has heard this. */
function timeLine(event: Partial<TraceEvent>) {
  start();
  const pen = new Pen(),
    store = new Store(),
    line = new TimeLine(store, new Client(store, new FakeLink()));
  store.takeWorld(world({ robots: [robot(1)] }), 1);
  document.body.append(line.pane);
  const canvas = line.pane.querySelector("canvas")!;
  canvas.getContext = (() => pen.context) as never;
  for (const element of [canvas, canvas.parentElement!]) Object.defineProperty(element, "clientWidth", { value: 1008 });
  line.shown = true;
  line.take({ robot: "puck", until: 2, signals: [], spans: [], changes: [], lost: 0, waits: false, ...event });
  const key = (name: string) => canvas.dispatchEvent(new KeyboardEvent("keydown", { key: name, bubbles: true }));
  return { pen, store, key, said: [...line.pane.querySelectorAll("output")].pop()! };
}

const kFirst = 208; // px, where time begins

test("the time line's axis: uprights at whole steps of 1, 2 or 5, and what time they are", () => {
  // [keys, seconds seen up to 2 s, texts]
  const rows: [string, number, string[]][] = [
    ["", 0.2, ["1.8 s", "1.85 s", "1.9 s", "1.95 s", "2 s"]],
    ["+", 0.1, ["1.9 s", "1.92 s", "1.94 s", "1.96 s", "1.98 s", "2 s"]],
    ["++", 0.05, ["1.95 s", "1.96 s", "1.97 s", "1.98 s", "1.99 s", "2 s"]],
    ["++++++++", 0.2 / 256, ["1999.4 ms", "1999.6 ms", "1999.8 ms", "2000.0 ms"]],
    ["-", 0.4, ["1.6 s", "1.7 s", "1.8 s", "1.9 s", "2 s"]],
  ];
  for (const [keys, seen, texts] of rows) {
    const { pen, key } = timeLine({});
    for (const k of keys) key(k);
    const said = pen.of("text").filter((d) => / m?s$/.test(d.text)),
      uprights = pen.of("rect", kColours.line).filter((d) => d.points[0][2] === 1 && d.points[0][1] === 0);
    assert.deepEqual(
      said.map((d) => d.text),
      texts,
      keys,
    );
    texts.forEach((text, i) => {
      const x = 1008 - (800 * (2 - parseFloat(text) / (text.endsWith("ms") ? 1000 : 1))) / seen;
      near(uprights[i].points[0][0], x, text);
      near(said[i].points[0][0], x + 3, text);
    });
  }
});

test("the time line's rows: what ran when, levels and values of signals, bytes", () => {
  const [main, handler, callback, signal] = [0, 1, 2, 5].map((i) => lineColour(i, false));
  const { pen, key, said } = timeLine({
    spans: [
      [0, 1.5, 1.85, "busy"],
      [1, 1.85, 1.95, "waiting"],
      [2, 1.86, 1.88, "T1"],
      [4, 1.9, 1.92, "tick"],
      [2, 0.1, 0.2, "T1"],
    ],
    signals: [
      ["LED0", 1],
      ["LATD", 16],
    ],
    changes: [
      [0, 0.5, 0],
      [0, 1.85, 1],
      [0, 1.95, 0],
      [1, 1.82, 0x2a],
      [1, 1.9, 7],
    ],
  });
  const x = (time: number) => kFirst + (time - 1.8) * 4000,
    top = (row: number) => 20 + 20 * row + 3;
  // [colour, row, from, to, px high]: what was before the picture is cut off, or not drawn
  const spans: [string, number, number, number, number][] = [
    [main, 0, 1.8, 1.85, 14],
    [kColours.line, 0, 1.85, 1.95, 2],
    [main, 0, 1.95, 2, 14], // still goes on
    [handler, 1, 1.86, 1.88, 14],
    [callback, 2, 1.9, 1.92, 14],
  ];
  const rects = pen.of("rect").filter((d) => d.points[0][0] >= kFirst && d.points[0][2] > 1 && d.points[0][2] < 800);
  assert.equal(rects.length, spans.length);
  spans.forEach(([colour, row, from, to, high], i) => {
    const [left, y, wide, tall] = rects[i].points[0];
    assert.equal(rects[i].colour, colour);
    near(left, x(from), "from");
    near(left + wide, x(to), "to");
    assert.deepEqual([y, tall], [top(row) + (high === 2 ? 6 : 0), high]);
  });
  // a level is a curve, low at first; a register's values stand between its changes
  const [level, values] = pen.of("stroke", signal);
  const low = top(3) + 14;
  assert.deepEqual(
    level.points.map(([, y]) => y),
    [low, low, top(3), top(3), low, low],
  );
  level.points.forEach(([at], i) => near(at, x([1.8, 1.85, 1.85, 1.95, 1.95, 2][i])));
  assert.equal(values.points.length, 12);
  const written = pen.of("text").filter((d) => d.text.startsWith("0x"));
  assert.deepEqual(
    written.map((d) => d.text),
    ["0x2a", "0x7"],
  );
  near(written[1].points[0][0], x(1.9) + 3);
  // a row that keys are on says what was at the cursor
  for (const k of ["ArrowLeft", "ArrowDown", "ArrowDown", "ArrowDown", "ArrowDown"]) key(k);
  assert.match(said.textContent!, /^1\.996.*LATD = 0x7$/);
  key("ArrowUp");
  assert.match(said.textContent!, /LED0 = 0$/);
});
