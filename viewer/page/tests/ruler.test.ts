// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import "./dom";
import { measured, textOf } from "../src/scene/ruler";

test("distance and direction, from the x axis against the clock", () => {
  // [x, y, distance, degrees]
  for (const [x, y, distance, angle] of [
    [1, 0, 1, 0],
    [0, 2, 2, 90],
    [-1, 0, 1, 180],
    [0, -1, 1, -90],
    [3, 4, 5, 53.1],
    [-1, -1, Math.SQRT2, -135],
  ]) {
    const m = measured({ x: 0.5, y: -0.25 }, { x: 0.5 + x, y: -0.25 + y });
    assert.ok(Math.abs(m.distance - distance) < 1e-9);
    assert.ok(Math.abs(m.angle - angle) < 0.05);
    assert.deepEqual([m.dx, m.dy], [x, y]);
  }
});

test("the ruler's words: three decimals of a metre, one of a degree, no minus before a zero", () => {
  const said = (x: number, y: number) => textOf({ x: 0, y: 0 }, { x, y }).replace(/\u202f/g, " ");
  assert.equal(said(0.3, -0.4), "0.500 m  −53.1°  (x 0.300 m, y −0.400 m)");
  assert.equal(said(-1, 0), "1.000 m  180.0°  (x −1.000 m, y 0.000 m)");
  assert.equal(said(1, -0.0005), "1.000 m  0.0°  (x 1.000 m, y −0.001 m)");
  assert.equal(said(1, -0.001), "1.000 m  −0.1°  (x 1.000 m, y −0.001 m)");
});
