// SPDX-License-Identifier: MIT
// Pages that go, hostile pages, kills.
import assert from "node:assert/strict";
import fs from "node:fs";
import net from "node:net";
import { ask, open } from "./harness.mjs";
import { kWorld, program, start, steps } from "./worlds.mjs";

export const tests = {
  // closed, reloaded or killed: the run is that of the same inputs
  async a_page_that_goes_changes_nothing(browser, live) {
    const digest = async (disturb) => {
      const [, page] = await start(browser, live, kWorld, { drive: program(400) });
      await steps(page, 50);
      let last = page;
      if (disturb) {
        await page.reload();
        await page.context().close();
        last = await open(browser, live[live.length - 1]);
      }
      await ask(last, "(app) => app.do('step', { unit: 'control', count: 50 })");
      return ask(last, "(app) => app.connection.ask('state').then((a) => a.state.digest + a.state.clicks)");
    };
    assert.equal(await digest(true), await digest(false));
  },

  async a_hostile_page_is_refused(browser, live) {
    const [v, page] = await start(browser, live);
    const url = new URL(v.address);
    const other = await (await browser.newContext()).newPage();
    await other.route("http://evil.example/", (r) => r.fulfill({ contentType: "text/html", body: "<title>evil</title>" }));
    await other.goto("http://evil.example/");
    const result = await other.evaluate(async (address) => {
      const out = {};
      const live = address.replace("http", "ws") + "live";
      // it even knows the token
      out.socket = await new Promise((done) => { const s = new WebSocket(live); s.onopen = () => done("open"); s.onerror = () => done("refused"); });
      out.fetch = await fetch(address).then((r) => r.text()).catch(() => "refused");
      return out;
    }, v.address);
    assert.deepEqual(result, { socket: "refused", fetch: "refused" });
    const noToken = await (await browser.newContext()).newPage();
    assert.equal((await noToken.goto(`http://127.0.0.1:${url.port}/`)).status(), 403);
    // garbage on the bare connection
    await new Promise((done) => { const s = net.connect(Number(url.port), "127.0.0.1", () => s.end(Buffer.alloc(100000, 0xa5))); s.on("close", done); s.on("error", done); s.resume(); });
    // 100 MB in one message from a page that was let in
    const large = await open(browser, v);
    await large.evaluate(async (address) => {
      const s = new WebSocket(address.replace("http", "ws") + "live");
      await new Promise((done) => (s.onopen = done));
      s.send(new Uint8Array(100 << 20));
      await new Promise((done) => (s.onclose = done));
    }, v.address);
    await steps(page, 3);
  },

  async kill_9_leaves_the_old_file_or_the_new_one(browser, live) {
    for (const ms of [0, 3, 10, 30, 80]) {
      const [v, page] = await start(browser, live);
      const wall = await ask(page, "(app) => app.world.things[0].id");
      await ask(page, "(app, id) => app.set(id, { colour: [0, 0, 0] })", wall);
      const fresh = await ask(page, "(app) => app.world.text");
      page.evaluate(() => { for (let i = 0; i < 400; ++i) window.twinpuck.connection.ask("save").catch(() => {}); }).catch(() => {});
      await page.waitForTimeout(ms);
      process.kill(v.pid, "SIGKILL");
      await page.waitForTimeout(50);
      assert.ok([kWorld, fresh].includes(fs.readFileSync(v.file, "utf8")), `killed after ${ms} ms`);
      await page.context().close();
    }
  },
};
