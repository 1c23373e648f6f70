// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import { test } from "node:test";
import { changedWorld } from "../src/store/changes";

const box = (id: number, x: number) => ({ id, kind: "box", position: [x, 0] }) as any;
const element = (id: number, line: number) =>
  ({ id, path: "box", name: "", line, last_line: line + 1, values: {} }) as any;
const world = {
  title: "old",
  text: "a\nb\nc\nd",
  things: [box(1, 0.1), box(2, 0.2)],
  robots: [{ id: 3, name: "puck", colour: [1, 0, 0] }],
  elements: [element(1, 1), element(2, 3)],
  problems: [],
} as any;
const none = { fresh: [], order: [] };

test("a piece that moved, one that came, one that went", () => {
  const now = changedWorld(world, {
    head: { title: "new", problems: [] } as any,
    text: { above: 1, gone: 2, lines: ["B", "B2", "C"] },
    things: { fresh: [box(2, 0.5), box(9, 0.9)], order: [9, 2] },
    robots: { fresh: [], order: [3] },
    elements: { fresh: [element(9, 0)], order: [2, 9], lines: [1, 2, 4, 5] },
  });
  assert.equal(now.title, "new");
  assert.equal(now.text, "a\nB\nB2\nC\nd");
  assert.deepEqual(now.things, [box(9, 0.9), box(2, 0.5)]);
  assert.deepEqual(now.robots, world.robots);
  assert.deepEqual(
    now.elements.map((e) => [e.id, e.line, e.last_line]),
    [
      [2, 1, 2],
      [9, 4, 5],
    ],
  );
  // what was is as it was: somebody may compare
  assert.equal(world.elements[1].line, 3);
  assert.notEqual(now.robots[0], world.robots[0]);
});

test("the last line has no break behind it", () => {
  const now = changedWorld(world, {
    head: {} as any,
    text: { above: 3, gone: 1, lines: [""] },
    things: none,
    robots: none,
    elements: { ...none, lines: [] },
  });
  assert.equal(now.text, "a\nb\nc\n");
});
