// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { Quality } from "../src/scene/quality";

/** Frames of that many ms, a second apart, until the time is over; how often it changed. */
function frames(q: Quality, ms: number, from: number, count: number) {
  let changes = 0;
  for (let i = 0; i < count; ++i) if (q.took(ms, from + 1000 * i)) ++changes;
  return changes;
}

test("quick frames leave nothing out", () => {
  const q = new Quality();
  assert.equal(frames(q, 10, 0, 200), 0);
  assert.deepEqual(q.leftOut, []);
});

test("more than 50 ms a frame: shadows first, then antialiasing, and so on; never more than there is", () => {
  const q = new Quality(0, true, 2);
  for (let i = 0; q.level < 1; ++i) q.took(60, i);
  assert.deepEqual(q.leftOut, ["shadows"]);
  assert.equal(q.ratio, 2);
  frames(q, 60, 0, 100);
  assert.deepEqual(q.leftOut, ["shadows", "antialiasing", "fine pixels", "details of robots", "half of the pixels"]);
  assert.equal(q.ratio, 0.7);
  assert.equal(q.details, false);
});

test("a screen without fine pixels has none to leave out", () => {
  const q = new Quality(0, true, 1);
  frames(q, 60, 0, 100);
  assert.deepEqual(q.leftOut, ["shadows", "antialiasing", "details of robots", "half of the pixels"]);
});

test("one slow frame is none, for another program may have had the processor", () => {
  const q = new Quality();
  for (let i = 0; i < 100; ++i) q.took(i % 10 ? 20 : 120, 1000 * i);
  assert.equal(q.level, 0);
});

test("where there is time it comes back, and what did not do is tried later and later", () => {
  const q = new Quality();
  for (let i = 0; q.level < 1; ++i) q.took(60, i);
  const waits: number[] = [];
  let now = 0;
  for (let round = 0; round < 3; ++round) {
    const begun = now;
    while (q.level === 1) q.took(5, (now += 100));
    waits.push(now - begun);
    while (q.level === 0) q.took(60, (now += 100));
  }
  assert.ok(waits[0] >= 5000 && waits[1] >= 2 * 5000 && waits[2] >= 4 * 5000, waits.join());
});

test("who asks for all gets all", () => {
  const q = new Quality(3);
  q.setMeasures(false, 0);
  assert.equal(frames(q, 900, 0, 50), 0);
  assert.deepEqual(q.leftOut, []);
});
