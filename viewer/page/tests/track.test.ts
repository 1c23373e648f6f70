// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { bordersOf, wayBetween } from "../src/scene/track";
import type { Border, Seen } from "../src/scene/track";
import { world } from "./worlds";

const at = (x: number, y: number, heading: number, time: number, travelled?: number): Seen => ({
  x,
  y,
  heading,
  time,
  travelled,
});
const kWall: Border = [0.5, -1, 0.5, 1];

test("between two frames of real time a path is straight", () => {
  assert.deepEqual(wayBetween(at(0, 0, 0, 0), at(0.004, 0, 0, 0.032), []), [[0.004, 0]]);
});

test("a robot that was carried leaves a gap: nothing drives 0.2 m in 32 ms", () => {
  assert.equal(wayBetween(at(0, 0, 0, 0), at(0.2, 0, 0, 0.032), []), undefined);
  assert.equal(wayBetween(at(0, 0, 0, 1), at(0.2, 0, 0, 1), []), undefined);
});

test("a quarter of a circle is drawn as one, as long as the odometer says", () => {
  // radius 0.2 m about (0, 0.2): from (0, 0) eastwards to (0.2, 0.2) northwards, pi / 2 times 0.2 = 0.314 m
  const way = wayBetween(at(0, 0, 0, 0, 1), at(0.2, 0.2, Math.PI / 2, 3, 1.314), [])!;
  assert.ok(way.length > 20);
  for (const [x, y] of way) assert.ok(Math.abs(Math.hypot(x, y - 0.2) - 0.2) < 0.01, `${x} ${y}`);
  assert.deepEqual(
    way[way.length - 1].map((v) => +v.toFixed(9)),
    [0.2, 0.2],
  );
});

test("backwards, too", () => {
  const way = wayBetween(at(0, 0, Math.PI, 0, 0), at(0.2, 0, Math.PI, 2, 0.2), [])!;
  for (const [, y] of way) assert.ok(Math.abs(y) < 1e-9);
});

test("a slow robot among a thousand, whose frames come every half second, leaves no gap", () => {
  assert.deepEqual(wayBetween(at(0, 0, 0, 0), at(0.02, 0, 1, 0.5), []), [[0.02, 0]]);
});

test("without an odometer an arc at full speed is known, and a slow way is not", () => {
  assert.ok(wayBetween(at(0, 0, 0, 0), at(0.26, 0, 0, 2), []));
  assert.equal(wayBetween(at(0, 0, 0, 0), at(0.05, 0, 0, 2), []), undefined);
  assert.equal(wayBetween(at(0, 0, 0, 0), at(0.26, 0, 2, 2), []), undefined);
});

test("who has gone farther than any curve between the two places leaves a gap", () => {
  assert.equal(wayBetween(at(0, 0, 0, 0, 0), at(0.2, 0, 0, 20, 1.9), []), undefined);
});

test("never through a wall", () => {
  assert.ok(wayBetween(at(0.3, 0, 0, 0, 0), at(0.48, 0, 0, 2, 0.18), [kWall]));
  assert.equal(wayBetween(at(0.4, 0, 0, 0, 0), at(0.6, 0, 0, 2, 0.2), [kWall]), undefined);
});

test("walls, boxes and the arena are borders; what moves, what hangs, and ramps are not", () => {
  const box = { id: 1, kind: "box", position: [0.5, 0], size: [0.2, 0.4, 0.1], heading: 0, colour: [1, 1, 1] };
  const given = (things: any[]) => bordersOf({ ...world(), arena: undefined, things });
  assert.deepEqual(
    given([box]).map((b) => b.map((v) => +v.toFixed(9))),
    [
      [0.4, -0.2, 0.6, -0.2],
      [0.6, -0.2, 0.6, 0.2],
      [0.6, 0.2, 0.4, 0.2],
      [0.4, 0.2, 0.4, -0.2],
    ],
  );
  assert.equal(given([{ ...box, movable: true }]).length, 0);
  assert.equal(given([{ ...box, z: 0.2 }]).length, 0);
  assert.equal(given([{ ...box, kind: "ramp" }]).length, 0);
  const wall = {
    id: 2,
    kind: "wall",
    position: [0, 0],
    points: [
      [0, 0],
      [1, 0],
      [1, 1],
    ],
    colour: [1, 1, 1],
  };
  assert.deepEqual(given([wall]), [
    [0, 0, 1, 0],
    [1, 0, 1, 1],
  ]);
});

test("an arc between two headings bends to the side on which the robot turned", () => {
  // the same quarter circle with and without an odometer: 0.314 m in 2.44 s at full speed
  for (const travelled of [undefined, 0.314])
    for (const left of [1, -1]) {
      const end = at(0.2, 0.2 * left, (Math.PI / 2) * left, 2.44, travelled);
      for (const [x, y] of wayBetween(at(0, 0, 0, 0, travelled && 0), end, [])!)
        assert.ok(Math.abs(Math.hypot(x, y - 0.2 * left) - 0.2) < 0.01, `${x} ${y}`);
    }
});
