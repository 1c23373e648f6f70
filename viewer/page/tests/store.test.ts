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
