// SPDX-License-Identifier: MIT
// The lab, docs/start.md, done wholly in the page.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { ask, at, drag, picture, root, until } from "./harness.mjs";
import { start } from "./worlds.mjs";

/** By the button, as people do. */
async function saveAsIn(page, name) {
  await page.click("#save-as");
  await page.fill("#question-text", name);
  await page.press("#question-text", "Enter");
  await until(page, "(app, name) => app.state.saved && document.querySelector('#file').textContent === name", name);
}

export const tests = {
  // docs/start.md, "In the page": I1, S2, S4 and S5
  async the_labs_items_are_done_wholly_in_the_page(browser, live) {
    const [v, page] = await start(browser, live, fs.readFileSync(path.join(root, "worlds/epuck.toml"), "utf8"), {}, ["--fw", "obstacle"]);
    const things = () => ask(page, "(app) => app.world.things.length");
    const saveAs = (name) => saveAsIn(page, name);
    // I1: a box is copied, moved and stretched; the robot runs, and its rays are shown
    const boxes = await things(), box = await ask(page, "(app) => { const t = app.world.things.find((t) => t.kind === 'box'); return [...t.position, t.size[2]]; }");
    const p = await at(page, ...box);
    await page.mouse.click(p.x, p.y);
    await page.keyboard.press("Control+d");
    await until(page, "(app, n) => app.world.things.length === n && app.selectedThing()?.kind === 'box'", boxes + 1);
    const end = await ask(page, "(app) => { const h = app.touch.handles()[0]; return [h.x, h.y, h.z]; }"), size = await ask(page, "(app) => app.selectedThing().size[0]");
    const a = await ask(page, "(app) => app.selectedThing().heading ?? 0");
    await drag(page, end, [end[0] + 0.08 * Math.cos(a), end[1] + 0.08 * Math.sin(a), end[2]]);
    await until(page, "(app, size) => app.selectedThing().size[0] > size + 0.04", size);
    await page.keyboard.press("y");
    await page.click("#play");
    await until(page, "(app) => app.frame.rays.length > 0 && app.frame.time > 0.5");
    await picture(page, "lab_I1");
    await saveAs("myobstacle.toml");
    // S2: a corridor with a dead end, in mid-run
    for (const [from, to] of [[[-0.1, -0.2], [0.3, -0.2]], [[-0.1, -0.32], [0.3, -0.32]], [[0.3, -0.2], [0.3, -0.32]]]) {
      const before = await things();
      await page.click("#tool-wall");
      await drag(page, from, to);
      await until(page, "(app, n) => app.world.things.length === n && app.selectedThing()?.kind === 'wall'", before + 1);
    }
    await picture(page, "lab_S2");
    await saveAs("u_obstacle.toml");
    // S4: painted black, then white
    for (const [tool, colour] of [["black", "0,0,0"], ["white", "1,1,1"]]) {
      await page.click(`#tool-${tool}`);
      const wall = await at(page, 0.1, -0.2, 0.1);
      await page.mouse.click(wall.x, wall.y);
      await until(page, "(app, c) => app.world.things.some((t) => t.kind === 'wall' && t.colour.join() === c)", colour);
      await picture(page, `lab_S4_${tool}`);
      await saveAs(`u_obstacle_${tool}.toml`);
    }
    // S5: three robots more; the run has begun, so it asks
    await page.click("#tool-select");
    await page.click("#play");
    await until(page, "(app) => !app.state.playing");
    for (let n = 2; n <= 4; ++n) {
      await ask(page, "(app) => app.select(app.world.robots[0].id)");
      await page.keyboard.press("Control+d");
      if (n === 2) await page.click("#anew");
      await until(page, "(app, n) => app.world.robots.length === n && app.selected !== app.world.robots[0].id", n);
      await ask(page, "(app, n) => app.set(app.world.robots.find((r) => r.id === app.selected).id, { position: [-0.45 + 0.1 * n, 0.44] })", n);
    }
    await until(page, "(app) => app.frame.robots === 4");
    await picture(page, "lab_S5");
    await saveAs("multi_obstacle.toml");
    for (const [name, robots] of [["myobstacle", 1], ["u_obstacle", 1], ["u_obstacle_black", 1], ["u_obstacle_white", 1], ["multi_obstacle", 4]]) {
      const run = spawnSync(path.join(root, "build/twinpuck"), ["run", `${name}.toml`, "--fw", "obstacle", "--for", "5", "--summary", "s.json", "-q"], { cwd: v.folder });
      assert.equal(run.status, 0, name + String(run.stderr));
      const summary = JSON.parse(v.read("s.json"));
      assert.equal(summary.robots.length, robots, name);
      assert.ok(summary.robots[0].distance_m > 0.02, name);
    }
    assert.match(v.read("u_obstacle_black.toml"), /colour = \[0, 0, 0\]/);
    assert.deepEqual(page.errors, []);
  },

  // I13: four rays for all sensors; S14: no noise; S15: more, and noisy wheels
  async the_sensors_settings_are_made_in_the_page(browser, live) {
    const [v, page] = await start(browser, live, fs.readFileSync(path.join(root, "worlds/u_obstacle.toml"), "utf8"), {}, ["--fw", "braiten"]);
    await page.keyboard.press("Escape");
    await page.locator("details.section", { hasText: "[proximity]" }).locator("summary").first().click();
    const set = async (section, key, value) => {
      // a row is in its place, or among those that are not written
      await ask(page, "() => document.querySelectorAll('#inspector details').forEach((d) => (d.open = true))");
      const field = page.locator(`#inspector [data-section=${section}][data-key=${key}]`);
      await field.fill(value);
      await field.press("Enter");
      await until(page, "(app, text) => app.world.text.includes(text)", `${key} = ${value}`);
    };
    for (const [key, value] of [["rays", "4"], ["aperture_rad", "0.3"], ["gaussian_width", "1"]]) await set("proximity", key, value);
    await page.click("#rays");
    await until(page, "(app) => app.frame.rays.length === 8 * 4 * 7");
    await picture(page, "lab_I13");
    await saveAsIn(page, "rays.toml");
    await set("proximity", "noise_scale", "0");
    await picture(page, "lab_S14");
    await saveAsIn(page, "silent.toml");
    await set("proximity", "noise_scale", "3");
    await picture(page, "lab_S15");
    await saveAsIn(page, "loud.toml");
    for (const name of ["rays", "silent", "loud"]) {
      const run = spawnSync(path.join(root, "build/twinpuck"), ["run", `${name}.toml`, "--fw", "braiten", "--for", "2", "--summary", "s.json", "-q"], { cwd: v.folder });
      assert.equal(run.status, 0, name + String(run.stderr));
    }
    assert.match(v.read("silent.toml"), /noise_scale = 0\n/);
    assert.deepEqual(page.errors, []);
  },
};
