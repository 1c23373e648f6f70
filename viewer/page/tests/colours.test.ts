// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { coloursOf, kPalette, lineColour } from "../src/store/colours";
import { element, robot, world } from "./worlds";

test("a robot has the colour of the file, or the next of ours", () => {
  const robots = Array.from({ length: 10 }, (_, i) => robot(i + 1, { colour: [0.5, 0.25, 0.125] }));
  const colours = coloursOf(world({ robots, elements: [element(2, "robot", 3, { colour: "[0.5, 0.25, 0.125]" })] }));
  assert.deepEqual(colours.get(2), [0.5, 0.25, 0.125]);
  assert.deepEqual(colours.get(1), [0, 0x69 / 255, 0xa6 / 255]);
  assert.deepEqual(colours.get(3), [0, 0x73 / 255, 0x4f / 255]);
  assert.deepEqual(colours.get(9), colours.get(1)); // there are eight
});

test("lines have eight colours on light and on dark ground", () => {
  for (const dark of [false, true]) {
    const eight = new Set(Array.from({ length: 8 }, (_, i) => lineColour(i, dark)));
    assert.equal(eight.size, 8);
    assert.equal(lineColour(8, dark), lineColour(0, dark));
  }
  assert.equal(lineColour(3, false), kPalette[3]);
});
