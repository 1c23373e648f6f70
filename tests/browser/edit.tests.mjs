// SPDX-License-Identifier: MIT
// The world is changed by hand.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { ask, at, drag, open, root, until, view } from "./harness.mjs";
import { kWorld, start, x, time, steps } from "./worlds.mjs";

export const tests = {
  async a_wall_dragged_into_the_way_stops_the_robot(browser, live) {
    const [v, page] = await start(browser, live);
    await steps(page, 20);
    await drag(page, [0.3, 0.3, 0.1], [0.1, 0.0, 0.1]);
    await until(page, "(app) => Math.abs(app.world.things[0].position[1]) < 0.03");
    // the drag's last moves may still be under way
    let wall, before;
    do {
      before = String(wall);
      await page.waitForTimeout(500);
      wall = await ask(page, "(app) => app.world.things[0].position");
    } while (String(wall) !== before);
    assert.ok((await time(page)) > 0.5, "the run goes on");
    await steps(page, 400);
    const stopped = await x(page);
    assert.ok(Math.abs(stopped - (wall[0] - 0.01 - 0.037)) < 0.004, `stands at ${stopped} before a wall at ${wall[0]}`);
    assert.equal(v.read("world.toml"), kWorld, "not saved yet");
    await page.click("#save");
    await until(page, "(app) => app.state.saved");
    const saved = v.read("world.toml");
    const line = kWorld.split("\n").findIndex((l) => l.startsWith("position = [0.30"));
    kWorld.split("\n").forEach((l, i) => { if (i !== line) assert.equal(saved.split("\n")[i], l); });
    assert.match(saved.split("\n")[line], /^position = \[0\.\d\d, 0\.\d\d\]$|^position = \[0\.\d\d, -0\.\d\d\]$/);
    assert.deepEqual(page.errors, []);
  },

  async paint_undo_and_redo(browser, live) {
    const [, page] = await start(browser, live);
    const colour = () => ask(page, "(app) => app.world.things[0].colour.join()");
    await page.click("#tool-black");
    const p = await at(page, 0.3, 0.3, 0.1);
    await page.mouse.click(p.x, p.y);
    await until(page, "(app) => app.world.things[0].colour.join() === '0,0,0'");
    await page.click("#undo");
    await until(page, "(app) => app.world.things[0].colour.join() === '1,1,1'");
    await page.keyboard.press("Control+y");
    await until(page, "(app) => app.world.things[0].colour.join() === '0,0,0'");
    assert.equal(await colour(), "0,0,0");
  },

  async a_world_drawn_from_nothing_runs_from_the_command_line(browser, live) {
    const [v, page] = await start(browser, live, "twinpuck = 1\n[arena]\nsize = [1, 1]\n");
    await page.click("#tool-wall");
    await drag(page, [-0.2, 0.3], [0.3, 0.3]);
    await until(page, "(app) => app.world.things.length === 1 && app.world.things[0].points[1][0] > 0.25");
    await page.click("#tool-box");
    const b = await at(page, 0.2, 0);
    await page.mouse.click(b.x, b.y);
    await until(page, "(app) => app.world.things.length === 2");
    // stretched at its eastern side
    const side = await ask(page, "(app) => { const h = app.touch.handles()[0]; return [h.x, h.y, h.z]; }");
    await drag(page, side, [side[0] + 0.1, side[1], side[2]]);
    await until(page, "(app) => app.world.things.some((t) => t.kind === 'box' && t.size[0] > 0.15)");
    await page.click("#tool-robot");
    const r = await at(page, -0.3, -0.2);
    await page.mouse.click(r.x, r.y);
    await until(page, "(app) => app.world.robots.length === 1");
    await ask(page, "(app) => app.connection.ask('save_as', { name: 'drawn.toml' })");
    const run = spawnSync(path.join(root, "build/twinpuck"), ["run", "drawn.toml", "--for", "5", "--summary", "s.json", "-q"], { cwd: v.folder });
    assert.equal(run.status, 0, String(run.stderr));
    assert.ok(JSON.parse(v.read("s.json")).robots[0].distance_m > 0.05);
  },

  async robots_are_added_and_copied(browser, live) {
    const [, page] = await start(browser, live);
    await steps(page, 5);
    await ask(page, "(app) => app.select(app.world.robots[0].id)");
    await page.keyboard.press("Control+d");
    // the run has begun: it asks first, once the simulation has said why
    await page.waitForSelector("#leave");
    assert.match(await page.textContent("#question"), /robots come and go only when a run begins/);
    await page.click("#leave");
    assert.equal(await ask(page, "(app) => app.world.robots.length"), 1);
    assert.ok((await time(page)) > 0);
    await page.keyboard.press("Control+d");
    await page.click("#anew");
    await until(page, "(app) => app.world.robots.length === 2 && app.frame.robots === 2");
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 0.5 && app.frame.poses[4] > -0.29");
    await page.keyboard.press("Delete");
    await page.click("#anew");
    await until(page, "(app) => app.world.robots.length === 1");
  },

  async the_floor_has_its_picture(browser, live) {
    const [v, page] = await start(browser, live);
    fs.copyFileSync(path.join(root, "worlds/line.png"), path.join(v.folder, "line.png"));
    const other = await view("twinpuck = 1\n[arena]\nsize = [1, 1]\n[floor]\nimage = \"" + path.join(v.folder, "line.png") + "\"\n");
    live.push(other);
    const there = await open(browser, other);
    await until(there, "(app) => app.scene.floor?.image.width > 10");
    const expected = fs.readFileSync(path.join(v.folder, "line.png")).readUInt32BE(16);
    assert.equal(await ask(there, "(app) => app.scene.floor.image.width"), expected);
    assert.equal(await ask(page, "(app) => app.scene.floor ?? null"), null);
  },
};
