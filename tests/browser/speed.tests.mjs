// SPDX-License-Identifier: MIT
// Figures of docs/dev/performance.md.
import assert from "node:assert/strict";
import { ask, until } from "./harness.mjs";
import { program, swarm, start } from "./worlds.mjs";

export const tests = {
  async a_simulation_runs_as_fast_with_a_page(browser, live) {
    const [v, page] = await start(browser, live, swarm(10), { drive: program(100) });
    await ask(page, "(app) => { app.do('speed', { factor: 'max' }); app.do('play'); }");
    // a page without a script, for short questions only
    const clock = await (await browser.newContext()).newPage();
    await clock.goto(v.address + "page.css");
    const now = () => clock.evaluate((address) => new Promise((done) => {
      const s = new WebSocket(address.replace("http", "ws") + "live");
      s.onmessage = ({ data }) => { if (typeof data === "string" && JSON.parse(data).event === "hello") { done([JSON.parse(data).state.time_s, performance.now() / 1000]); s.close(); } };
    }), v.address);
    const rate = async () => {
      const [from, begin] = await now();
      await new Promise((done) => setTimeout(done, 2000));
      const [to, end] = await now();
      return (to - from) / (end - begin);
    };
    const ratios = [];
    for (let i = 0; i < 4; ++i) {
      await page.goto("about:blank");
      const without = await rate();
      await page.goto(v.address);
      await page.waitForFunction(() => window.twinpuck?.frames > 0);
      // headless chromium draws with the processor that the simulation needs
      await ask(page, "(app) => { app.scene.setDrawing(false); app.select(app.world.robots[0].id); }");
      ratios.push((await rate()) / without);
    }
    ratios.sort((a, b) => a - b);
    const middle = (ratios[1] + ratios[2]) / 2;
    console.log(`     ten robots at full speed with a page: ${middle.toFixed(2)} times as fast as without (bar 0.8)`);
    assert.ok(middle > 0.2);  // a busy machine has no processor left for the page
  },

  // figures of docs/dev/performance.md; bars are loose, since the machine may be busy
  async frames_and_the_work_for_them(browser, live) {
    for (const [n, perSecond, bar] of [[10, 60, 4], [1000, 20, 4]]) {
      const [, page] = await start(browser, live, swarm(n), { drive: program(100) });
      await ask(page, "(app) => { app.scene.setDrawing(false); app.select(app.world.robots[0].id); app.do('play'); }");
      for (const name of ["ir0", "speed", "left_steps", "mic0"]) await ask(page, "(app, name) => app.plots.toggle(name)", `r0.${name}`);
      await until(page, "(app) => app.frame.time > 0.2", null, 60000);
      await page.waitForTimeout(500);
      const [frames, mean, most] = await page.evaluate(async () => {
        const app = window.twinpuck, before = app.frames;
        app.work.length = 0;
        await new Promise((done) => setTimeout(done, 3000));
        const sorted = [...app.work].sort((a, b) => a - b);
        return [(app.frames - before) / 3, sorted.reduce((a, b) => a + b) / sorted.length, sorted[Math.floor(sorted.length * 0.95)]];
      });
      console.log(`     ${n} robots, inspector and four plots: ${frames.toFixed(0)} frames/s, ${mean.toFixed(2)} ms of work each, 95 of 100 below ${most.toFixed(2)} (bars ${perSecond}, ${bar})`);
      assert.ok(mean < 2 * bar);
      assert.ok(frames > perSecond / 3);
      await page.context().close();
    }
  },

  // a thousand robots against one, since a busy machine draws both slowly: 20 times as long when each was drawn in
  // all its parts with a path of its own, 1.4 times now
  async a_thousand_robots_are_drawn_nearly_as_fast_as_one(browser, live) {
    const pages = [];
    for (const n of [1, 1000]) {
      const [, page] = await start(browser, live, swarm(n), { drive: program(100) });
      await ask(page, "(app) => { app.scene.setDrawing(false); app.scene.canvas.setMeasures(false); }");
      await page.waitForTimeout(500);
      pages.push(page);
    }
    // a frame after the other, all robots moved; the last pixel is waited for
    const draw = (page, k) => page.evaluate((k) => {
      const { scene, frame } = window.twinpuck;
      for (let i = 0; i < frame.robots; ++i) frame.poses[4 * i] += 0.003 * (k % 2 ? 1 : -1);
      scene.canvas.finish();
      const begin = performance.now();
      scene.setFrame({ ...frame, time: 0.032 * (k + 1) });
      const script = performance.now() - begin;
      scene.drawNow();
      scene.canvas.finish();
      return [script, performance.now() - begin];
    }, k);
    const took = [[], []], scripts = [];
    for (let k = 0; k < 12; ++k)
      for (const i of [0, 1]) {
        const [script, all] = await draw(pages[i], k);
        if (k < 3) continue;  // shaders are made
        took[i].push(all);
        if (i) scripts.push(script);
      }
    const middle = (list) => list.sort((a, b) => a - b)[list.length >> 1];
    const [one, many] = took.map(middle), script = middle(scripts);
    console.log(`     drawn in software: ${many.toFixed(0)} ms a frame of 1000 robots (bar 400), ${(many / one).toFixed(1)} times one robot's; placing them ${script.toFixed(1)} ms (bar 4)`);
    assert.ok(many < 5 * one);
    assert.ok(script < 8);
    for (const page of pages) assert.deepEqual(page.errors, []);
  },
};
