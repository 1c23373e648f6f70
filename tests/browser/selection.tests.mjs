// SPDX-License-Identifier: MIT
// A tool for a day: sizes, the list of pieces, several at once, the clipboard, worlds (issue 38, 7).
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { ask, at, drag, picture, until } from "./harness.mjs";
import { kWorld, program, start } from "./worlds.mjs";

const many = `twinpuck = 1
[arena]
size = [1.0, 1.0]
${[[-0.2, 0.2], [0, 0.2], [0.2, 0.2]].map(([x, y], i) => `
[[box]]
name = "wall"
position = [${x}, ${y}]
size = [0.05, 0.05, 0.1]
`).join("")}
[[robot]]
name = "puck"
firmware = "drive"
position = [-0.3, -0.3]
`;
const chosen = (page) => ask(page, "(app) => app.store.selection.length");
/** Whether the server does many edits at once. */
const doesMany = async (page) => (await ask(page, "(app) => app.connection.ask('edit', { edits: [] }).then(() => '', (e) => e.message)")).includes("op") === false;

export const tests = {
  async sizes_and_folds_are_remembered(browser, live) {
    const [v, page] = await start(browser, live);
    const width = () => page.evaluate(() => document.getElementById("side").getBoundingClientRect().width);
    const before = await width(), bar = await page.locator("#split-side").boundingBox();
    await page.mouse.move(bar.x + 2, bar.y + 100);
    await page.mouse.down();
    await page.mouse.move(bar.x - 78, bar.y + 100, { steps: 5 });
    await page.mouse.up();
    assert.ok(Math.abs((await width()) - before - 80) < 6, `${before} to ${await width()}`);
    // by the keyboard, too
    await page.focus("#split-dock");
    const height = () => page.evaluate(() => document.getElementById("dock").getBoundingClientRect().height);
    const low = await height();
    await page.keyboard.press("ArrowUp");
    await page.keyboard.press("ArrowUp");
    assert.ok((await height()) > low + 20);
    await page.locator("#tree .fold").click();
    assert.equal(await page.locator("#pieces").isVisible(), false);
    const wide = await width();
    await page.reload();
    await page.waitForFunction(() => document.body.dataset.ready === "yes");
    assert.ok(Math.abs((await width()) - wide) < 2);
    assert.equal(await page.locator("#pieces").isVisible(), false);
    assert.ok((await height()) > low + 20);
    await page.context().close();
    assert.deepEqual(page.errors, []);
    void v;
  },

  async the_list_has_names_places_and_lines(browser, live) {
    const [, page] = await start(browser, live, many);
    const rows = await page.$$eval("#pieces li", (all) => all.map((r) => r.textContent));
    assert.equal(rows.length, 4);
    assert.equal(new Set(rows).size, 4, "three walls of one name are told apart");
    assert.match(rows[0], /puck · drive.*-0\.30 -0\.30 m:\d+/);
    assert.match(rows[1], /wall · box-0\.20 0\.20 m:5$/);
    await page.click("#pieces li >> nth=1");
    assert.equal(await ask(page, "(app) => app.selectedThing().position[0]"), -0.2);
    await page.keyboard.press("ArrowDown");
    assert.equal(await ask(page, "(app) => app.selectedThing().position[0]"), 0);
    assert.equal(await ask(page, "(app) => app.world.things[1].position[0]"), 0, "arrows in the list move no wall");
    await page.keyboard.press("Shift+ArrowDown");
    assert.equal(await chosen(page), 2);
    await page.fill("#piece-filter", "puck");
    assert.equal(await page.locator("#pieces li").count(), 1);
    await page.fill("#piece-filter", "");
    await page.locator("#pieces li").nth(2).dblclick();
    await page.waitForFunction(() => document.querySelector("#tab-text").getAttribute("aria-selected") === "true");
    await picture(page, "selection_list");
    assert.deepEqual(page.errors, []);
  },

  async several_are_moved_painted_and_deleted_in_one_step(browser, live) {
    const [, page] = await start(browser, live, many);
    const click = async (x, y, modifiers = []) => {
      const p = await at(page, x, y, 0.1);
      for (const m of modifiers) await page.keyboard.down(m);
      await page.mouse.click(p.x, p.y);
      for (const m of modifiers) await page.keyboard.up(m);
    };
    await click(-0.2, 0.2);
    await click(0, 0.2, ["Shift"]);
    assert.equal(await chosen(page), 2);
    await click(0, 0.2, ["Control"]);
    assert.equal(await chosen(page), 1);
    // a frame on the floor
    await page.keyboard.press("Escape");
    await page.keyboard.down("Shift");
    await drag(page, [-0.35, 0.35], [0.1, 0.1]);
    await page.keyboard.up("Shift");
    assert.equal(await chosen(page), 2);
    await picture(page, "selection_several");
    if (!(await doesMany(page))) return console.log("     the server does one edit at a time yet");
    await drag(page, [0, 0.2, 0.1], [0.05, 0.0, 0.1]);
    const places = "(app) => app.world.things.map((t) => t.position.map((v) => Math.round(v * 100) / 100).join())";
    await until(page, "(app) => app.world.things[1].position[1] < 0.05");
    const moved = await ask(page, places);
    assert.equal(moved[2], "0.2,0.2");
    assert.ok(Math.abs(Number(moved[0].split(",")[1]) - Number(moved[1].split(",")[1])) < 1e-6, "they keep their distance");
    await page.click("#undo");
    await until(page, "(app) => app.world.things[0].position[1] === 0.2 && app.world.things[1].position[1] === 0.2");
    await page.locator(".swatches button[title=black]").click();
    await until(page, "(app) => app.world.things.filter((t) => t.colour.join() === '0,0,0').length === 2");
    await page.keyboard.press("Delete");
    await until(page, "(app) => app.world.things.length === 1");
    await page.click("#undo");
    await until(page, "(app) => app.world.things.length === 3");
    assert.deepEqual(page.errors, []);
  },

  async pieces_go_through_the_clipboard(browser, live) {
    const [, page] = await start(browser, live, many);
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    const knows = await ask(page, "(app) => app.connection.ask('text_of', { things: [app.world.things[0].id] }).then((a) => a.text, () => '')");
    if (!knows) return console.log("     the server gives no pieces' text yet");
    await page.click("#pieces li >> nth=1");
    await page.keyboard.press("Control+c");
    await page.waitForFunction(() => /1 piece copied/.test(document.querySelector("#notice").textContent));
    assert.match(await page.evaluate(() => navigator.clipboard.readText()), /^\[\[box\]\]/);
    await page.keyboard.press("Control+v");
    await until(page, "(app) => app.world.things.length === 4 && app.selectedThing()?.position[0] === -0.1");
    await page.keyboard.press("Control+v");
    await until(page, "(app) => app.world.things.length === 5 && app.selectedThing()?.position[0] === 0");
    await page.keyboard.press("Control+x");
    await until(page, "(app) => app.world.things.length === 4");
    // text that a person copied elsewhere
    await page.evaluate(() => navigator.clipboard.writeText('[[cylinder]]\nposition = [0.3, -0.3]\nradius = 0.05\n'));
    await page.keyboard.press("Control+v");
    await until(page, "(app) => app.world.things.some((t) => t.kind === 'cylinder')");
    // in a field the clipboard is the field's
    const before = await ask(page, "(app) => app.world.things.length");
    await page.focus("#piece-filter");
    await page.keyboard.press("Control+v");
    assert.equal(await ask(page, "(app) => app.world.things.length"), before);
    assert.deepEqual(page.errors, []);
  },

  async another_world_is_opened_and_a_new_one_made(browser, live) {
    const [v, page] = await start(browser, live, kWorld, { drive: program(100) });
    const knows = await ask(page, "(app) => app.connection.ask('worlds').then(() => true, () => false)");
    if (!knows) return console.log("     the server lists no worlds yet");
    fs.writeFileSync(path.join(v.folder, "second.toml"), many);
    await page.click("#open-world");
    await page.waitForSelector("#worlds button:has-text('second.toml')");
    await picture(page, "worlds_menu");
    await ask(page, "(app) => app.set(app.world.things[0].id, { colour: [0, 0, 0] })");
    await page.click("#worlds button:has-text('second.toml')");
    await page.click("#discard");
    await page.waitForFunction(() => document.querySelector("#file").textContent === "second.toml");
    await until(page, "(app) => app.world.things.length === 3");
    assert.equal(v.read("world.toml"), kWorld);
    await page.click("#open-world");
    await page.click("#new-world");
    await page.fill("#question-text", "fresh");
    await page.press("#question-text", "Enter");
    await page.waitForFunction(() => document.querySelector("#file").textContent === "fresh.toml");
    assert.ok(v.read("fresh.toml").includes("[arena]"));
    await until(page, "(app) => app.world.things.length === 0");
    assert.deepEqual(page.errors, []);
  },
};
