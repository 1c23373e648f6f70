// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { FakeLink, freshDocument, settle } from "./dom";
import { readFrame } from "../src/link/protocol";
import { Client } from "../src/store/client";
import { Store } from "../src/store/store";
import { thing, world } from "./worlds";

/** A frame without bodies: revision, time, subscription, values. */
function frame(revision: number, time: number, subscription: number, values: number[]) {
  const bytes = new ArrayBuffer(48 + 8 * values.length),
    head = new DataView(bytes);
  head.setUint32(4, revision, true);
  head.setFloat64(8, time, true);
  head.setUint32(36, values.length, true);
  head.setUint32(44, subscription, true);
  values.forEach((v, i) => head.setFloat64(48 + 8 * i, v, true));
  return bytes;
}
function start() {
  freshDocument();
  const store = new Store(),
    link = new FakeLink(),
    client = new Client(store, link);
  return { store, link, client };
}
const hear = (link: FakeLink, bytes: ArrayBuffer) => link.onFrame(readFrame(bytes), bytes);

test("a selection loses what the world has no more", () => {
  const { store } = start();
  store.takeWorld(world({ things: [thing(1), thing(2), thing(3)] }), 1);
  store.selectAll([1, 3]);
  assert.equal(store.selected, 3);
  store.takeWorld(world({ things: [thing(1), thing(2)] }), 2);
  assert.deepEqual(store.selection, [1]);
});

test("a frame of another world is not kept", async () => {
  const { store, link } = start();
  store.takeWorld(world(), 4);
  hear(link, frame(3, 1, 1, []));
  assert.equal(store.past.frames.length, 0);
  hear(link, frame(4, 1, 1, []));
  assert.equal(store.past.frames.length, 1);
  assert.equal(store.frame!.time, 1);
});

test("values have the names that were asked for, also of frames that came before", async () => {
  const { store, link, client } = start();
  let wanted = ["puck.x"];
  store.wanted.push(() => wanted);
  store.takeWorld(world(), 1);
  let next = 1;
  link.answers.subscribe = () => ({ subscription: next++ });
  await client.subscribe();
  hear(link, frame(1, 0.1, 1, [7]));
  wanted = ["puck.y", "puck.x"];
  await client.subscribe();
  hear(link, frame(1, 0.2, 2, [8, 9]));
  assert.equal(store.values.get("puck.x"), 9);
  const seen: unknown[] = [];
  store.past.each(["puck.y", "puck.x"], (time, values) => seen.push([time, values]));
  assert.deepEqual(seen, [
    [0.1, [null, 7]],
    [0.2, [8, 9]],
  ]);
});

test("an earlier time of the server's is a new run: nothing of the old one stays", async () => {
  const { store, link } = start();
  store.takeWorld(world(), 1);
  const state = { ...store.state, time_s: 5 };
  link.event("state", { state });
  hear(link, frame(1, 5, 1, []));
  store.traps.push({ robot: "puck", kind: "math error", text: "", place: "", file: "", line: 0, time_s: 1 });
  link.event("state", { state: { ...state, time_s: 0 } });
  assert.equal(store.past.frames.length, 0);
  assert.deepEqual(store.traps, []);
  await settle();
});

test("what ends a run, a recording or the server is said in the page", async () => {
  const { store, link } = start();
  const box = document.getElementById("notice")!,
    said = () => [box.textContent, box.className];
  const tell = (more: object) => link.event("state", { state: { ...store.state, ...more } });
  const nothing = said();
  tell({});
  assert.deepEqual(said(), nothing);
  tell({ ended: true, outcome: { code: 0, text: "three goals" } });
  assert.deepEqual(said(), ["three goals", "shown"]);
  tell({ ended: true, outcome: { code: 1, text: "" } });
  assert.deepEqual(said(), ["The supervisor has ended the run", "bad shown"]);
  tell({ ended: false, outcome: undefined, recording: { file: "r.jsonl", error: "no space left" } });
  assert.deepEqual(said(), ["The recording r.jsonl: no space left", "bad shown"]);
  link.event("problems", { problems: [] });
  assert.deepEqual(said(), ["The recording r.jsonl: no space left", "bad shown"]);
  link.event("problems", { problems: ["puck: two of that name", "more"] });
  assert.deepEqual(said(), ["puck: two of that name", "bad shown"]);
  tell({ recording: { file: "r.jsonl", error: "no space left" } }); // it was said
  assert.deepEqual(said(), ["puck: two of that name", "bad shown"]);
  link.onClose();
  assert.deepEqual(said(), [
    "twinpuck view has ended. Start it again and open the address that it prints.",
    "bad shown",
  ]);
  assert.equal(document.body.dataset.ready, "gone");
  await settle();
});

test("a run begins with the first frame behind 0 s, and again after a reset", () => {
  const { store, link } = start();
  store.takeWorld(world(), 1);
  const began: boolean[] = [];
  store.on("frame", (told) => began.push((told as { began: boolean }).began));
  for (const time of [0, 0, 0.1, 0.2, 0, 0.1]) hear(link, frame(1, time, 1, []));
  assert.deepEqual(began, [false, false, true, false, true, true]);
});
