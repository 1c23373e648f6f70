// SPDX-License-Identifier: MIT
// What people type is kept: a buffer for each file, conflicts, questions before a loss (issue 38, 1 and 2).
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { ask, between, drag, picture, until, view } from "./harness.mjs";
import { kWorld, program, start } from "./worlds.mjs";

const source = (page) => ask(page, "(app) => app.program.text()");
const type = async (page, where, text) => {
  await page.click(`${where} .cm-content`);
  await page.keyboard.press("Control+Home");
  await page.keyboard.insertText(text);
};
const show = (page, file) => page.selectOption("#source-file", file);
/** A page of a view with two files in its controller. */
async function twoFiles(browser, live, change) {
  const v = await view(kWorld, { drive: program(100) });
  live.push(v);
  v.write("drive/help.c", "int help;\n");
  await new Promise((done) => setTimeout(done, 400));
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 } });
  const page = await context.newPage();
  page.errors = [];
  page.on("pageerror", (e) => page.errors.push(String(e)));
  if (change) await between(page, change);
  await page.goto(v.address);
  await page.waitForFunction(() => document.body.dataset.ready === "yes");
  await page.click("#tab-program");
  await show(page, "drive\nmain.c");
  await until(page, "(app) => app.program.text().includes('e_set_speed_left')");
  return [v, page];
}
/** Whether the server keeps bases of files: version 2 of the protocol. */
const hasBases = (page) => ask(page, "(app) => app.buffers.get('drive\\nmain.c')?.base !== undefined");

export const tests = {
  async a_file_whose_text_has_not_come_is_not_saved(browser, live) {
    let hold;
    const [v, page] = await twoFiles(browser, live, async (request) => {
      if (request.do === "source" && request.file === "main.c" && hold) await hold;
    });
    const main = v.read("drive/main.c");
    await show(page, "drive\nhelp.c");
    await until(page, "(app) => app.program.text() === 'int help;\\n'");
    // main.c has been read; another page writes it, so that its text is asked for again at the next opening
    await ask(page, "(app) => { app.buffers.get('drive\\nmain.c').read = undefined; }");
    let come;
    hold = new Promise((done) => (come = done));
    await show(page, "drive\nmain.c");
    await page.click("#source .cm-content");
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => /has not come/.test(document.querySelector("#notice").textContent));
    await page.keyboard.insertText("nonsense");
    come();
    await until(page, "(app) => app.program.text().includes('e_set_speed_left')");
    assert.equal(v.read("drive/main.c"), main);
    assert.equal(v.read("drive/help.c"), "int help;\n");
    assert.equal(await source(page), main, "nothing is typed into what has not come");
    assert.deepEqual(page.errors, []);
  },

  async unsaved_text_outlives_other_files_and_robots(browser, live) {
    const [v, page] = await twoFiles(browser, live);
    const main = v.read("drive/main.c");
    await type(page, "#source", "// mine\n");
    await page.waitForFunction(() => /^• /.test(document.querySelector("#source-file").selectedOptions[0].textContent));
    await show(page, "drive\nhelp.c");
    await until(page, "(app) => app.program.text() === 'int help;\\n'");
    await ask(page, "(app) => { app.select(0); app.select(app.world.robots[0].id); }");
    await show(page, "drive\nmain.c");
    await until(page, "(app) => app.program.text().startsWith('// mine')");
    await picture(page, "keep_dot");
    // leaving asks first
    let asked = false;
    page.on("dialog", (d) => { asked = d.type() === "beforeunload"; d.dismiss(); });
    await page.close({ runBeforeUnload: true });
    for (const end = Date.now() + 5000; !asked && Date.now() < end;) await new Promise((done) => setTimeout(done, 50));
    assert.ok(asked);
    // undo of one file is not that of another
    await page.click("#source .cm-content");
    await page.keyboard.press("Control+z");
    await until(page, "(app, main) => app.program.text() === main", main);
    await page.waitForFunction(() => !/^• /.test(document.querySelector("#source-file").selectedOptions[0].textContent));
    assert.deepEqual(page.errors, []);
  },

  async another_editors_text_is_not_overwritten(browser, live) {
    const [v, page] = await twoFiles(browser, live);
    if (!(await hasBases(page))) return console.log("     the server keeps no bases yet");
    const theirs = "// theirs\n" + v.read("drive/main.c");
    await type(page, "#source", "// mine\n");
    v.write("drive/main.c", theirs);
    await page.waitForSelector("#source-compare");
    assert.match(await page.textContent("#source-conflict"), /main\.c was changed on the disk by another program/);
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => /nothing was saved/.test(document.querySelector("#notice").textContent));
    assert.equal(v.read("drive/main.c"), theirs);
    await page.click("#source-compare");
    await page.waitForSelector("#source .cm-deletedChunk, #source .cm-changedLine");
    await picture(page, "keep_compare");
    await page.click("#source-reload");
    await until(page, "(app, theirs) => app.program.text() === theirs", theirs);
    // and the other way
    await type(page, "#source", "// mine again\n");
    v.write("drive/main.c", "// third\n" + theirs);
    await page.waitForSelector("#source-overwrite");
    await page.click("#source-overwrite");
    await until(page, "(app) => !app.buffers.dirty().length");
    assert.match(v.read("drive/main.c"), /^\/\/ mine again\n\/\/ theirs/);
    // a clean buffer follows the disk
    v.write("drive/main.c", theirs);
    await until(page, "(app, theirs) => app.program.text() === theirs", theirs);
    assert.equal(await page.locator("#source-conflict .banner").count(), 0);
    assert.deepEqual(page.errors, []);
  },

  async a_read_only_file_is_told_and_stays(browser, live) {
    const [v, page] = await twoFiles(browser, live);
    if (!(await hasBases(page))) return console.log("     the server knows no read-only files yet");
    const main = v.read("drive/main.c");
    fs.chmodSync(path.join(v.folder, "drive/main.c"), 0o444);
    await type(page, "#source", "// mine\n");
    await page.keyboard.press("Control+s");
    await page.waitForFunction(() => /read-only/.test(document.querySelector("#notice").textContent));
    assert.equal(v.read("drive/main.c"), main);
    assert.match(await source(page), /^\/\/ mine/);
    fs.chmodSync(v.file, 0o444);
    const wall = await ask(page, "(app) => app.world.things[0].id");
    await ask(page, "(app, id) => app.set(id, { colour: [0, 0, 0] })", wall);
    await page.click("#save");
    await page.waitForSelector("#save-elsewhere");
    assert.match(await page.textContent("#question"), /read-only/);
    await picture(page, "keep_read_only");
    await page.click("#leave");
    assert.equal(v.read("world.toml"), kWorld);
  },

  async typed_text_of_the_world_outlives_a_drag(browser, live) {
    const [v, page] = await start(browser, live);
    await page.click("#tab-text");
    await until(page, "(app) => app.text.editor.text.length > 0");
    await type(page, "#world-text", "# mine\n");
    assert.match(await page.textContent("#world-text-state"), /not applied/);
    // a wall is dragged meanwhile
    const wall = await ask(page, "(app) => app.world.things[0].position");
    await drag(page, [...wall, 0.1], [0.1, 0.1, 0.1]);
    await until(page, "(app) => app.world.things[0].position[0] < 0.15");
    const text = await ask(page, "(app) => app.text.editor.text");
    assert.match(text, /^# mine\n# a driver/, "what was typed stays");
    const dragged = await ask(page, "(app) => app.world.things[0].position");
    await page.click("#apply");
    await until(page, "(app) => app.world.text.startsWith('# mine')");
    assert.deepEqual(await ask(page, "(app) => app.world.things[0].position"), dragged, "and what was dragged");
    await until(page, "(app) => !app.buffers.dirty().length");
    // the same line from two sides
    await ask(page, "(app) => app.buffers.edit('world', app.world.text.replace(/position = \\[.*\\]/, 'position = [0.2, 0.2]'))");
    await ask(page, "(app) => { app.store.tell('buffer', app.buffers.world); }");
    await ask(page, "(app) => app.set(app.world.things[0].id, { position: [0.3, 0.1] })");
    await page.waitForSelector("#world-compare");
    await page.click("#apply");
    await page.waitForFunction(() => /nothing was applied/.test(document.querySelector("#notice").textContent));
    await page.click("#world-compare");
    await picture(page, "keep_world_conflict");
    await page.click("#world-overwrite");
    await until(page, "(app) => app.world.things[0].position[0] === 0.2");
    assert.equal(await page.locator("#world-conflict .banner").count(), 0);
    // Save asks what is to be done with text that is not applied
    await type(page, "#world-text", "# more\n");
    await page.click("#save");
    await page.click("#apply-first");
    await until(page, "(app) => app.state.saved && app.world.text.startsWith('# more')");
    assert.match(v.read("world.toml"), /^# more\n# mine/);
    assert.deepEqual(page.errors, []);
  },

  async the_worlds_file_that_changed_is_asked_about(browser, live) {
    const [v, page] = await start(browser, live);
    if ((await ask(page, "(app) => app.world.base ?? null")) === null) return console.log("     the server tells of no files yet");
    const theirs = kWorld.replace("0.30, 0.30", "0.10, 0.20");
    v.write("world.toml", theirs);
    await page.waitForSelector("#disk-reload");
    await picture(page, "keep_world_disk");
    await page.click("#leave");
    await ask(page, "(app) => app.set(app.world.things[0].id, { colour: [0, 0, 0] })");
    await page.click("#save");
    await page.waitForSelector("#disk-overwrite");
    assert.equal(v.read("world.toml"), theirs);
    await page.click("#disk-reload");
    await until(page, "(app) => app.world.things[0].position[0] === 0.1");
    await page.click("#undo");
    await until(page, "(app) => app.world.things[0].position[0] === 0.3");
    assert.deepEqual(page.errors, []);
  },

  async the_bar_has_the_name_after_save_as(browser, live) {
    const [v, page] = await start(browser, live);
    await page.click("#save-as");
    await page.fill("#question-text", "other");
    await page.press("#question-text", "Enter");
    await page.waitForFunction(() => document.querySelector("#file").textContent === "other.toml");
    assert.equal(v.read("other.toml"), kWorld);
  },
};
