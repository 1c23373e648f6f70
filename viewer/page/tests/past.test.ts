// SPDX-License-Identifier: MIT
// What the page keeps of a run, and what it lets go of.
import assert from "node:assert/strict";
import test from "node:test";
import type { Look } from "../src/link/protocol";
import { Past } from "../src/store/past";

const look = (robot: string, time_s: number) => ({ robot, time_s }) as Look;

test("frames are kept up to a number and up to their bytes; the oldest go", () => {
  // [frames, bytes each, frames that are left]
  for (const [count, size, left] of [
    [20000, 8, 20000],
    [20001, 8, 20000],
    [20010, 8, 20000],
    [12, 8 << 20, 12],
    [13, 8 << 20, 12],
    [4, 32 << 20, 3],
  ]) {
    const past = new Past();
    for (let i = 0; i < count; ++i) past.keep(i, new ArrayBuffer(size));
    assert.equal(past.frames.length, left);
    assert.equal(past.frames[0].time, count - left);
    assert.equal(past.frames[left - 1].time, count - 1);
    // what went counts no more
    past.keep(count, new ArrayBuffer(size));
    assert.equal(past.frames.length, Math.min(left + 1, size > 8 ? (96 << 20) / size : 20000));
  }
});

test("the last look of a robot until a time, that time included", () => {
  const past = new Past();
  for (const [robot, time_s] of [
    ["a", 0],
    ["b", 0.5],
    ["a", 1],
    ["a", 2],
  ] as const)
    past.keepLook(look(robot, time_s));
  const at = (robot: string, until?: number) => past.lookOf(robot, until)?.time_s;
  assert.deepEqual(
    [at("a"), at("a", 2), at("a", 1.999), at("a", 1), at("a", 0), at("a", -1)],
    [2, 2, 1, 1, 0, undefined],
  );
  assert.deepEqual([at("b"), at("b", 0.4), at("c")], [0.5, undefined, undefined]);
  past.forget();
  assert.equal(at("a"), undefined);
});

test("of more than 3000 looks a quarter goes, the oldest", () => {
  const past = new Past();
  for (let i = 0; i < 3000; ++i) past.keepLook(look("a", i));
  assert.equal(past.lookOf("a", 0)?.time_s, 0);
  past.keepLook(look("a", 3000));
  assert.equal(past.lookOf("a", 749.5), undefined);
  assert.equal(past.lookOf("a", 750)?.time_s, 750);
  assert.equal(past.lookOf("a")?.time_s, 3000);
});
