// SPDX-License-Identifier: MIT
// Where robots went: pieces of line, whose they are, and which of them the drawing gets.
import assert from "node:assert/strict";
import test from "node:test";
import * as THREE from "three";
import { Paths } from "../src/scene/paths";
import { robot } from "./worlds";

const rounded = (pieces: number[][]) => pieces.map((p) => p.map((v) => +v.toFixed(4)));
/** Eastwards in steps of 4 mm, real time. */
function drive(paths: Paths, body: number, from: number, steps: number) {
  for (let k = 0; k <= steps; ++k) paths.add(body, 0.004 * (from + k), body, 0, 0.032 * (from + k));
}
const ranges = (paths: Paths, name: string) =>
  (paths.lines.geometry.getAttribute(name) as THREE.BufferAttribute).updateRanges;

test("pieces follow one another and belong to their robot", () => {
  const paths = new Paths();
  paths.setRobots([robot(1, { colour: [1, 0, 0] }), robot(2, { colour: [0, 0, 1] })]);
  drive(paths, 0, 0, 3);
  drive(paths, 1, 10, 1);
  paths.add(2, 0, 0, 0, 0); // there is no such robot
  assert.deepEqual(rounded(paths.pieces(0)), [
    [0, 0, 0.004, 0],
    [0.004, 0, 0.008, 0],
    [0.008, 0, 0.012, 0],
  ]);
  assert.deepEqual(rounded(paths.pieces(1)), [[0.04, 1, 0.044, 1]]);
  assert.equal(paths.of(0).count, 3);
  assert.equal(paths.of(1).count, 1);
  assert.equal(paths.of(7).count, 0);
  assert.deepEqual(paths.of(1).colour.toArray(), [0, 0, 1]);
});

test("what is too near is left out, and a jump is a gap with a dash behind it", () => {
  const paths = new Paths();
  paths.setRobots([robot(1)]);
  paths.add(0, 0, 0, 0, 0);
  paths.add(0, 0.001, 0, 0, 0.032);
  assert.deepEqual(paths.pieces(0), []);
  paths.add(0, 0.002, 0, 0, 0.064);
  assert.deepEqual(rounded(paths.pieces(0)), [[0, 0, 0.002, 0]]);
  paths.add(0, 1, 0, Math.PI / 2, 0.096); // it was carried
  assert.deepEqual(rounded(paths.pieces(0)).slice(1), [[1, -0.002, 1, 0.002]]);
  paths.clear();
  assert.deepEqual(paths.pieces(0), []);
  assert.equal(paths.of(0).count, 0);
});

test("the oldest go when it is full, and only what is new is drawn anew", () => {
  const paths = new Paths();
  paths.setRobots([robot(1)]);
  drive(paths, 0, 0, 3990);
  paths.flush();
  assert.equal(paths.of(0).count, 3990);
  assert.deepEqual(ranges(paths, "position"), [{ start: 0, count: 4 * 3990 }]);
  assert.deepEqual(ranges(paths, "color"), [{ start: 0, count: 6 * 3990 }]);
  assert.equal(paths.lines.geometry.drawRange.count, 2 * 3990);
  for (const name of ["position", "color"])
    (paths.lines.geometry.getAttribute(name) as THREE.BufferAttribute).clearUpdateRanges();
  paths.flush(); // nothing new
  assert.deepEqual(ranges(paths, "position"), []);
  for (let k = 3991; k <= 4015; ++k) paths.add(0, 0.004 * k, 0, 0, 0.032 * k);
  paths.flush();
  assert.equal(paths.of(0).count, 4000);
  assert.deepEqual(rounded(paths.pieces(0))[0], [0.06, 0, 0.064, 0]); // fifteen are gone
  assert.deepEqual(ranges(paths, "position"), [
    { start: 0, count: 4 * 15 },
    { start: 4 * 3990, count: 4 * 10 },
  ]);
  assert.equal(paths.lines.geometry.drawRange.count, 2 * 4000);
});
