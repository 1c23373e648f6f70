// SPDX-License-Identifier: MIT
// A live view in a folder of its own, and a page of it in chromium.
import { spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

export const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const twinpuck = path.join(root, "build/twinpuck");

/** Starts `twinpuck view` on a world of that text; programs are {name: text of main.c}. */
export async function view(world, programs = {}, more = []) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "twinpuck-browser-"));
  const file = path.join(folder, "world.toml");
  fs.writeFileSync(file, world);
  for (const [name, text] of Object.entries(programs)) {
    fs.mkdirSync(path.join(folder, name));
    fs.writeFileSync(path.join(folder, name, "main.c"), text);
  }
  const process_ = spawn(twinpuck, ["view", file, ...more], { stdio: ["ignore", "pipe", "pipe"], cwd: folder });
  let said = "";
  process_.stderr.on("data", (d) => (said += d));
  const address = await new Promise((done, fail) => {
    let out = "";
    process_.stdout.on("data", (d) => {
      out += d;
      const m = out.match(/open (http:\S+)/);
      if (m) done(m[1]);
    });
    process_.on("exit", () => fail(new Error(`twinpuck view ended: ${out}${said}`)));
  });
  const exited = new Promise((done) => process_.on("exit", done));
  return {
    address, folder, file, pid: process_.pid,
    read: (name) => fs.readFileSync(path.join(folder, name), "utf8"),
    write: (name, text) => fs.writeFileSync(path.join(folder, name), text),
    async end(signal = "SIGTERM") {
      process_.kill(signal);
      await exited;
      fs.rmSync(folder, { recursive: true, force: true });
    },
  };
}

export const launch = () =>
  chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"] });

/** A page of the view, once it has the world. Errors of its script fail the test. */
export async function open(browser, live, size = { width: 1280, height: 720 }, scheme = "light", runs = true) {
  const context = await browser.newContext({ viewport: size, colorScheme: scheme });
  const page = await context.newPage();
  page.errors = [];
  page.on("console", (m) => { if (m.type() === "error") page.errors.push(m.text()); });
  page.on("pageerror", (e) => page.errors.push(String(e)));
  await page.goto(live.address);
  await page.waitForFunction(() => document.body.dataset.ready === "yes", undefined, { timeout: 30000 }).catch((e) => { throw new Error(`${e.message}\n${page.errors.join("\n")}`); });
  if (runs) await page.waitForFunction(() => window.twinpuck.frames > 0);
  return page;
}

/** Something of the page's own state, by a function of the App. */
export const ask = (page, what, argument) => page.evaluate(`(${what})(window.twinpuck, ${JSON.stringify(argument)})`);
/** Waits until such a function says yes. (The page's policy forbids what waitForFunction does with texts.) */
export async function until(page, what, argument, ms = 20000) {
  for (const end = Date.now() + ms; !(await ask(page, what, argument)); await new Promise((done) => setTimeout(done, 20)))
    if (Date.now() > end) throw new Error(`never true: ${what}`);
}
/** Where a place of the world is, px. */
export const at = (page, x, y, z = 0) => ask(page, "(app, p) => app.scene.project(...p)", [x, y, z]);
export async function drag(page, from, to, steps = 12) {
  const a = await at(page, ...from), b = await at(page, ...to);
  await page.mouse.move(a.x, a.y);
  await page.mouse.down();
  for (let i = 1; i <= steps; ++i) {
    await page.mouse.move(a.x + ((b.x - a.x) * i) / steps, a.y + ((b.y - a.y) * i) / steps);
    await page.waitForTimeout(15);
  }
  await page.mouse.up();
}

/** The scene is not drawn: what a test looks at is elsewhere, and the processor is needed there. */
export const blind = (page) => ask(page, "(app) => app.scene.setDrawing(false)");
/** A picture of the page, for people: build/browser/NAME.png. */
export async function picture(page, name) {
  fs.mkdirSync(path.join(root, "build/browser"), { recursive: true });
  // a busy machine that draws by its processor has no time for a picture while a run goes on
  const played = await ask(page, "(app) => app.state.playing");
  await ask(page, "(app) => { app.scene.setDrawing(true); if (app.state.playing) app.do('pause'); }");
  await until(page, "(app) => !app.state.playing");
  await page.waitForTimeout(300);
  await page.screenshot({ path: path.join(root, "build/browser", `${name}.png`) });
  if (!played) return;
  await ask(page, "(app) => app.do('play')");
  await until(page, "(app) => app.state.playing");
}
/** Puts something between page and server: `change` gets each message of the page's and either answers it itself
 * (returns an object) or lets it pass (undefined). Called before the page is opened. */
export async function between(page, change) {
  await page.routeWebSocket(/\/live$/, (socket) => {
    const server = socket.connectToServer();
    const tell = (event) => socket.send(JSON.stringify(event));
    socket.onMessage(async (message) => {
      const request = JSON.parse(message);
      const answer = await change(request, tell);
      if (answer === undefined) server.send(message);
      else tell({ answer: request.id, ...answer });
    });
  });
}
