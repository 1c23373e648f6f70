// SPDX-License-Identifier: MIT
import assert from "node:assert/strict";
import test from "node:test";
import { FakeLink, freshDocument, refuse, settle } from "./dom";
import { isDirty, keyOf } from "../src/store/buffer";
import { Buffers } from "../src/store/buffers";
import { Client } from "../src/store/client";
import { merge } from "../src/store/merge";
import { Store } from "../src/store/store";
import { world } from "./worlds";

function start() {
  freshDocument();
  const store = new Store(),
    link = new FakeLink(),
    client = new Client(store, link);
  return { store, link, client, buffers: new Buffers(store, client) };
}

test("what has not come is not written", async () => {
  const { link, buffers } = start();
  let come = (_: any) => {};
  link.answers.source = () => new Promise((done) => (come = done));
  const opened = buffers.open("drive", "main.c");
  buffers.edit(keyOf("drive", "main.c"), "int help;");
  assert.equal(await buffers.save(keyOf("drive", "main.c")), "unread");
  await settle();
  come({ text: "int main;", base: "b1" });
  assert.equal((await opened).text, "int main;");
  assert.deepEqual(link.of("write_source"), []);
});

test("two who open a source at once read it once", async () => {
  const { link, buffers } = start();
  link.answers.source = () => ({ text: "one", base: "b1" });
  const [a, b] = await Promise.all([buffers.open("drive", "main.c"), buffers.open("drive", "main.c")]);
  assert.equal(a, b);
  assert.equal(link.of("source").length, 1);
  await buffers.open("drive", "main.c"); // it is known
  await buffers.open("drive", "other.c");
  assert.equal(link.of("source").length, 2);
});

test("text is saved over the bytes that were read, and the next time over those", async () => {
  const { link, buffers } = start();
  link.answers.source = () => ({ text: "one", base: "b1", writable: true });
  link.answers.write_source = () => ({ base: "b2" });
  const b = await buffers.open("drive", "main.c");
  buffers.edit(b.key, "two");
  assert.ok(isDirty(b));
  assert.equal(await buffers.save(b.key), "saved");
  assert.ok(!isDirty(b));
  buffers.edit(b.key, "three");
  await buffers.save(b.key);
  assert.deepEqual(
    link.of("write_source").map((w) => [w.base, w.text]),
    [
      ["b1", "two"],
      ["b2", "three"],
    ],
  );
});

test("what is typed while it is saved stays unsaved", async () => {
  const { link, buffers } = start();
  link.answers.source = () => ({ text: "one", base: "b1" });
  link.answers.write_source = () => {
    buffers.edit(keyOf("drive", "main.c"), "two and more");
    return { base: "b2" };
  };
  const b = await buffers.open("drive", "main.c");
  buffers.edit(b.key, "two");
  await buffers.save(b.key);
  assert.equal(b.text, "two and more");
  assert.equal(b.read, "two");
  assert.ok(isDirty(b));
});

test("a clean buffer follows the disk, a dirty one keeps what was typed and says so", async () => {
  const { link, buffers } = start();
  let disk = { text: "one", base: "b1" };
  link.answers.source = () => disk;
  const b = await buffers.open("drive", "main.c");
  disk = { text: "other", base: "b2" };
  link.event("disk", { program: "drive", file: "main.c", base: "b2" });
  await settle();
  assert.equal(b.text, "other");
  buffers.edit(b.key, "mine");
  disk = { text: "third", base: "b3" };
  link.event("disk", { program: "drive", file: "main.c", base: "b3" });
  await settle();
  assert.equal(b.text, "mine");
  assert.deepEqual(b.conflict, { base: "b3", text: "third" });
  assert.equal(await buffers.save(b.key), "conflict");
  assert.deepEqual(link.of("write_source"), []);
  link.answers.write_source = (more) => (assert.equal(more.overwrite, true), { base: "b4" });
  assert.equal(await buffers.save(b.key, true), "saved");
  assert.equal(b.conflict, undefined);
});

test("a refusal says what is on the disk; Reload takes it", async () => {
  const { link, buffers } = start();
  link.answers.source = () => ({ text: "one", base: "b1" });
  link.answers.write_source = () => refuse("another", { conflict: { base: "b9", text: "nine" } });
  const b = await buffers.open("drive", "main.c");
  buffers.edit(b.key, "mine");
  assert.equal(await buffers.save(b.key), "conflict");
  assert.equal(b.text, "mine");
  buffers.reload(b.key);
  assert.equal(b.text, "nine");
  assert.equal(b.base, "b9");
  assert.ok(!isDirty(b));
  buffers.edit(b.key, "again");
  link.answers.write_source = () => refuse("read-only", { readonly: true });
  assert.equal(await buffers.save(b.key), "readonly");
  assert.equal(b.writable, false);
  assert.equal(b.text, "again");
});

test("text of the world that was not applied outlives other edits", async () => {
  const { store, link, buffers } = start();
  const text = "a\nb\nc\nd\ne\n";
  store.takeWorld(world({ text, base: "w1" }), 1);
  buffers.edit("world", "a\nb\nc\nd\nmine\n");
  // another line is dragged
  store.takeWorld(world({ text: "a\ntheirs\nc\nd\ne\n", base: "w2" }), 2);
  const b = buffers.world;
  assert.equal(b.text, "a\ntheirs\nc\nd\nmine\n");
  assert.equal(b.conflict, undefined);
  assert.equal(await buffers.apply(), "saved");
  const sent = link.of("edit")[0];
  assert.equal(sent.base, "w2");
  assert.equal(sent.text, "a\ntheirs\nc\nd\nmine\n");
  // the same line: mine stays, theirs is told
  store.takeWorld(world({ text: "a\ntheirs\nc\nd\nother\n", base: "w3" }), 3);
  assert.equal(b.text, "a\ntheirs\nc\nd\nmine\n");
  assert.deepEqual(b.conflict, { base: "w3", text: "a\ntheirs\nc\nd\nother\n" });
  assert.equal(await buffers.apply(), "conflict");
  assert.equal(link.of("edit").length, 1);
  buffers.reload("world");
  assert.equal(b.text, "a\ntheirs\nc\nd\nother\n");
  assert.ok(!isDirty(b));
});

test("an edit that came before the text did is merged and sent again", async () => {
  const { store, link, buffers } = start();
  store.takeWorld(world({ text: "a\nb\nc\n", base: "w1" }), 1);
  buffers.edit("world", "a\nb\nmine\n");
  link.answers.edit = (more) =>
    more.base === "w1" ? refuse("another", { conflict: { base: "w2", text: "theirs\nb\nc\n" } }) : {};
  assert.equal(await buffers.apply(), "saved");
  assert.deepEqual(
    link.of("edit").map((e) => [e.base, e.text]),
    [
      ["w1", "a\nb\nmine\n"],
      ["w2", "theirs\nb\nmine\n"],
    ],
  );
});

test("texts are merged by lines", () => {
  assert.deepEqual(merge("a\nb", "a\nb", "x\nb"), { text: "x\nb", conflicts: [] });
  assert.deepEqual(merge("a\nb\nc", "x\nb\nc", "x\nb\ny"), { text: "x\nb\ny", conflicts: [] });
  assert.deepEqual(merge("a\nb\nc", "a\nm\nc", "a\nt\nc"), {
    text: "a\nm\nc",
    conflicts: [{ line: 2, mine: ["m"], theirs: ["t"] }],
  });
});
