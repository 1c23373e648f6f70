// SPDX-License-Identifier: MIT
// Time: the first picture, play and step, back and forth, plots, the time line, reports.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { ask, drag, root, until } from "./harness.mjs";
import { kWorld, program, start, x, time } from "./worlds.mjs";

export const tests = {
  async first_frame_comes_at_once(browser, live) {
    const [v] = await start(browser, live);
    const page = await browser.newPage();
    // written down by the page itself: the plan may have come and gone before anybody asks from outside
    await page.addInitScript(() => {
      window.seen = {};
      new MutationObserver(() => {
        if (!document.getElementById("plan") || window.seen.plan) return;
        window.seen = { plan: performance.now(), clock: document.getElementById("clock").textContent };
      }).observe(document, { childList: true, subtree: true });
    });
    await page.goto(v.address);
    await page.waitForFunction(() => window.twinpuck?.frames > 0 && !document.getElementById("plan"));
    const scene = await page.evaluate(() => performance.now());
    const seen = await page.evaluate(() => window.seen);
    assert.equal(seen.clock, "0.000 s");
    console.log(`     state on the page ${seen.plan.toFixed(0)} ms after opening, scene ${scene.toFixed(0)} ms (bar 1000)`);
    assert.ok(seen.plan < 3000);
  },

  async play_pause_step_and_speed(browser, live) {
    const [, page] = await start(browser, live);
    assert.equal(await time(page), 0);
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 0.3");
    await page.keyboard.press("Space");
    await until(page, "(app) => !app.state.playing");
    const paused = await time(page);
    await page.waitForTimeout(150);
    assert.equal(await time(page), paused);
    await page.keyboard.press("n");
    await until(page, "(app, t) => app.frame.time > t", paused);
    // to the next multiple of the time step, as a robot's program counts them; by whole ticks of 1/512 s
    const next = (Math.floor(paused / 0.032 + 0.01) + 1) * 0.032;
    assert.ok(Math.abs((await time(page)) - next) < 0.003, `${paused} to ${await time(page)}, expected ${next}`);
    await page.selectOption("#speed", "0");
    await page.click("#play");
    await until(page, "(app, t) => app.frame.time > t", paused + 20);
    await page.click("#restart");
    await until(page, "(app) => app.frame.time === 0 && !app.state.playing");
    assert.deepEqual(page.errors, []);
  },

  async back_and_forth_over_what_was_seen(browser, live) {
    const [, page] = await start(browser, live);
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 1");
    await page.click("#play");
    await until(page, "(app) => !app.state.playing");
    const end = await time(page);
    await page.evaluate(() => { const s = document.querySelector("#scrub"); s.value = "5"; s.dispatchEvent(new Event("input")); });
    assert.ok((await time(page)) < end / 2);
    await page.click("#play");
    await until(page, "(app, t) => app.frame.time > t", end);
  },

  async a_robot_is_dragged_while_it_runs(browser, live) {
    const [v, page] = await start(browser, live);
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 0.3");
    // slowly: where this sees it, it still is when the hand comes, on a busy machine, too
    await page.selectOption("#speed", "0.0625");
    await until(page, "(app) => app.state.speed === 0.0625");
    const from = await ask(page, "(app) => [app.frame.poses[0], app.frame.poses[1], 0.04]");
    await drag(page, from, [-0.1, -0.3, 0.04]);
    await until(page, "(app) => app.frame.poses[1] < -0.2");
    await page.click("#play");
    assert.equal(v.read("world.toml"), kWorld);
    assert.equal(await ask(page, "(app) => app.state.saved"), true);
  },

  async a_report_opens_from_disk_without_a_network(browser, live) {
    const [v] = await start(browser, live);
    const run = spawnSync(path.join(root, "build/twinpuck"), ["run", v.file, "--for", "60", "--report", "run.html", "-q"], { cwd: v.folder });
    assert.equal(run.status, 0, String(run.stderr));
    const bytes = fs.statSync(path.join(v.folder, "run.html")).size;
    console.log(`     a minute of one robot: ${(bytes / 1e6).toFixed(2)} MB`);
    assert.ok(bytes < 5e6);
    const page = await (await browser.newContext({ offline: true, viewport: { width: 1280, height: 720 } })).newPage();
    const errors = [];
    page.on("console", (m) => { if (m.type() === "error") errors.push(m.text()); });
    page.on("pageerror", (e) => errors.push(String(e)));
    await page.goto(`file://${v.folder}/run.html`);
    await page.waitForFunction(() => document.body.dataset.ready === "yes");
    assert.match(await page.textContent("#pane-summary"), /drive: 60\.0\u202fs simulated/);
    assert.match(await page.textContent("#pane-summary"), /x \(m\).*load \(%\).*battery used \(mWh\)/s);
    assert.equal(await page.textContent("#pane-summary td:nth-child(2)"), "drive");
    // the end, with the way that led there: 0.27 m until it stands before the wall of the arena
    assert.equal(await time(page), 60);
    assert.ok((await ask(page, "(app) => app.scene.paths.of(0).count")) > 100);
    assert.match(await page.textContent("#console-lines"), /hello/);
    const scrub = (at) => page.evaluate((i) => { const s = document.getElementById("scrub"); s.value = String(i); s.dispatchEvent(new Event("input")); }, at);
    await scrub(100);
    assert.ok(Math.abs((await time(page)) - 2) < 0.003);
    const early = await x(page);
    await scrub(250);
    assert.ok((await x(page)) > early + 0.1, "it drives");
    const points = () => ask(page, "(app) => app.scene.paths.of(0).count");
    const there = await points();
    assert.ok(there > 30, "the path is the one that was driven");
    await scrub(200);
    assert.ok((await points()) < there, "and ends where the robot was");
    await scrub(250);
    assert.equal(await points(), there);
    assert.equal(await ask(page, "(app) => app.values.get('puck.x') === app.frame.values[0]"), true);
    await ask(page, "(app) => app.plots.toggle('puck.ir0')");
    assert.equal(await ask(page, "(app) => app.plots.samples"), 3001);
    await page.click("#tab-timeline");
    assert.ok(await ask(page, "(app) => app.timeline.known.changes.some((n) => n > 2)"), "LED0 and the bytes");
    await scrub(0);
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 0.2");
    await page.click("#play");
    // at the end it begins anew
    await scrub(3000);
    assert.equal(await time(page), 60);
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 0 && app.frame.time < 30");
    await page.click("#play");
    assert.equal(await ask(page, "(app) => app.connection.ask('play').catch((e) => e.message)"), "a report shows what was; it cannot be changed");
    assert.deepEqual(errors, []);
  },

  async time_line_and_pins(browser, live) {
    const [, page] = await start(browser, live);
    await page.click("#tab-timeline");
    await page.click("#play");
    await until(page, "(app) => app.timeline.known.changes.some((n) => n > 20)");
    await page.fill("#signals", "LED0, left_coils, rounds");
    await page.press("#signals", "Enter");
    await until(page, "(app) => app.timeline.known.changes.length === 3 && app.timeline.known.changes[1] > 20 && app.timeline.known.changes[2] > 20");
    // a controller that is built anew is looked at, too
    await page.fill("#signals", "nonsense");
    await page.press("#signals", "Enter");
    await page.waitForFunction(() => /nonsense/.test(document.querySelector("#notice").textContent));
    await ask(page, "(app) => app.showDock('console')");
    await until(page, "(app) => !app.timeline.shown");
    assert.deepEqual(page.errors, []);
  },

  async what_came_later_than_what_is_shown_is_dim(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: program(400).replace("rounds++;", 'if (++rounds % 20 == 0) e_send_uart1_char("tick\\r\\n", 6);') });
    await page.click("#play");
    await page.waitForFunction(() => document.querySelectorAll("#console-lines > div").length > 8);
    await page.click("#play");
    await until(page, "(app) => !app.state.playing");
    const later = () => page.locator("#console-lines > .later").count();
    assert.equal(await later(), 0);
    await ask(page, "(app) => { const s = document.getElementById('scrub'); s.value = String(Math.floor(s.max / 2)); s.dispatchEvent(new Event('input')); }");
    const t = await time(page), times = await page.evaluate(() => [...document.querySelectorAll("#console-lines > div")].map((l) => Number(l.dataset.time)));
    assert.equal(await later(), times.filter((x) => x > t).length);
    assert.ok((await later()) > 0);
    // a plot of something new begins where it is known: what it was before nobody has kept
    await ask(page, "(app) => app.plots.toggle('puck.ir3')");
    assert.ok((await ask(page, "(app) => app.plots.samples")) > 10, "filled from the frames that are kept");
  },

  async rays_and_plots(browser, live) {
    const [, page] = await start(browser, live);
    await page.keyboard.press("y");
    await until(page, "(app) => app.frame.rays.length > 0");
    await page.click(".gauge[title^='puck.speed']");
    await page.fill("#plot-name", "puck.var:rounds");
    await page.press("#plot-name", "Enter");
    await until(page, "(app) => app.plots.names.length === 2");
    await page.click("#play");
    await until(page, "(app) => app.plots.samples > 30");
    assert.ok((await page.locator("#plot canvas").count()) === 1);
    await page.click("#play");
    await until(page, "(app) => !app.state.playing");
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("text=CSV")]);
    assert.equal(download.suggestedFilename(), "plot.csv");
    const [head, ...rows] = fs.readFileSync(await download.path(), "utf8").trimEnd().split("\n").map((l) => l.split(","));
    assert.match(head.join(), /^time_s,puck\.speed \(m\/s\),puck\.var:rounds$/);
    assert.equal(rows.length, await ask(page, "(app) => app.plots.samples"));
    assert.deepEqual(rows.at(-1).map(Number), await ask(page, "(app) => [app.frame.time, ...app.plots.names.map((n) => app.values.get(n))]"));
    await page.fill("#plot-name", "puck.nonsense");
    await page.press("#plot-name", "Enter");
    await page.waitForFunction(() => /expected a name/.test(document.querySelector("#notice").textContent));
    assert.deepEqual(page.errors, []);
  },
};
