// SPDX-License-Identifier: MIT
// The page without a mouse, with little room, with few colours (issue 38, 10).
import assert from "node:assert/strict";
import { ask, open, picture, until } from "./harness.mjs";
import { kWorld, program, start } from "./worlds.mjs";

/** What no screen reader could name. */
const nameless = () => {
  const named = (e) =>
    e.getAttribute("aria-label") || e.getAttribute("aria-labelledby") || (e.labels && e.labels.length) || e.textContent.trim() || (e.tagName === "INPUT" ? "" : e.title);
  return [...document.querySelectorAll("input,select,button,textarea,[tabindex='0'],[role]")]
    .filter((e) => !["presentation", "none", "alertdialog", "status", "tabpanel"].includes(e.getAttribute("role")) && !e.closest(".cm-editor .cm-panels"))
    .filter((e) => !named(e))
    .map((e) => e.outerHTML.slice(0, 120));
};
/** Texts whose contrast to what is behind them is below 4.5; of large letters 3. */
const tooFaint = () => {
  const canvas = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const rgba = (text) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = text;
    canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data];
  };
  const light = (c) => {
    const [r, g, b] = c.map((v) => (v / 255 <= 0.03928 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = (e) => {
    for (; e; e = e.parentElement) {
      const c = rgba(getComputedStyle(e).backgroundColor);
      if (c[3] > 250) return c;
    }
    return [255, 255, 255, 255];
  };
  const faint = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walk.nextNode(); node; node = walk.nextNode()) {
    const e = node.parentElement;
    if (!node.textContent.trim() || !e.checkVisibility({ opacityProperty: true, visibilityProperty: true }) || e.closest("[disabled],script,style,option,svg")) continue;
    const style = getComputedStyle(e), front = rgba(style.color), back = behind(e);
    const a = light(front.slice(0, 3)), b = light(back.slice(0, 3));
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    const large = parseFloat(style.fontSize) >= 24 || (parseFloat(style.fontSize) >= 18.66 && Number(style.fontWeight) >= 700);
    if (contrast < (large ? 3 : 4.5)) faint.push(`${contrast.toFixed(2)} ${e.tagName}.${e.className} ${node.textContent.trim().slice(0, 40)} ${style.color} on ${back}`);
  }
  return faint;
};

export const tests = {
  async every_field_has_a_name_and_every_text_is_readable(browser, live) {
    for (const scheme of ["light", "dark"]) {
      const [v, first] = await start(browser, live, kWorld, { drive: program(100) });
      await first.context().close();
      const page = await open(browser, v, { width: 1280, height: 720 }, scheme);
      await until(page, "(app) => app.program.text().length > 0");
      await ask(page, "(app) => { document.querySelectorAll('details').forEach((d) => (d.open = true)); app.console.say('puck', 'hello\\n', '', 1); app.debug.toggle('drive\\nmain.c', 12); }");
      for (const pane of ["console", "plots", "program", "timeline", "text", "problems"]) {
        await page.click(`#tab-${pane}`);
        await page.waitForTimeout(100);
        assert.deepEqual(await page.evaluate(nameless), [], `${pane}, ${scheme}`);
        assert.deepEqual(await page.evaluate(tooFaint), [], `${pane}, ${scheme}`);
      }
      await page.keyboard.press("Escape");
      for (const select of ["0", "app.world.things[0].id"]) {
        await ask(page, `(app) => { app.select(${select}); document.querySelectorAll('details').forEach((d) => (d.open = true)); }`);
        assert.deepEqual(await page.evaluate(nameless), [], select);
        assert.deepEqual(await page.evaluate(tooFaint), [], select);
      }
      await picture(page, `access_${scheme}`);
      assert.deepEqual(page.errors, []);
    }
  },

  async keys_belong_to_what_has_the_focus(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: program(0) });
    const place = () => ask(page, "(app) => app.world.robots[0].position.join() + ' ' + app.world.robots.length + app.world.things.length");
    const before = await place();
    await page.focus("#selector");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    await until(page, "(app) => app.values.get('puck.selector') === 2 || document.querySelector('#selector').value === '2'");
    await page.keyboard.press("Backspace");
    await page.keyboard.press("Delete");
    await page.fill("#console-input", "ab");
    await page.focus("#console-input");
    await page.keyboard.press("Backspace");
    assert.equal(await page.inputValue("#console-input"), "a");
    for (const id of ["#fan", "#ears", ".gauge .name", "#tab-console", "#split-side", "#console-lines"]) {
      await page.locator(id).first().focus();
      for (const key of ["ArrowLeft", "ArrowDown", "Backspace", "Delete", "q"]) await page.keyboard.press(key);
    }
    assert.equal(await place(), before, "nothing was moved, turned or deleted");
    // the scene has them where it has the focus, or nothing has
    await page.focus("#stage canvas");
    await page.keyboard.press("ArrowRight");
    await until(page, "(app) => Math.abs(app.world.robots[0].position[0] + 0.39) < 1e-6");
    assert.deepEqual(page.errors, []);
  },

  async a_robot_picked_in_the_list_obeys_the_documented_keys(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: program(0) });
    await page.locator("#pieces .row").first().click();
    await page.keyboard.press("q");
    await until(page, "(app) => Math.abs(app.world.robots[0].heading - Math.PI / 12) < 1e-6");
    await page.keyboard.press("Space");
    await until(page, "(app) => app.state.playing");
    await page.keyboard.press("Space");
    await until(page, "(app) => !app.state.playing");
    // the list has its own arrows
    const before = await ask(page, "(app) => app.world.robots[0].position.join()");
    await page.keyboard.press("ArrowDown");
    await until(page, "(app) => app.store.selectedThing()?.name === 'wall'");
    assert.equal(await ask(page, "(app) => app.world.robots[0].position.join()"), before);
    assert.deepEqual(page.errors, []);
  },

  async the_list_of_keys_is_scrolled_by_keys(browser, live) {
    const [v, first] = await start(browser, live, kWorld, { drive: program(0) });
    await first.context().close();
    const page = await open(browser, v, { width: 1000, height: 420 });
    await page.focus("#stage canvas");
    await page.keyboard.press("?");
    assert.equal(await page.evaluate(() => document.activeElement.id), "keys");
    await picture(page, "keys");
    await page.keyboard.press("End");
    await page.waitForFunction(() => {
      const keys = document.querySelector("#keys");
      return keys.scrollTop > 0 && keys.scrollTop + keys.clientHeight >= keys.scrollHeight - 2;
    });
    await page.keyboard.press("?");
    assert.equal(await page.isVisible("#keys"), false);
    assert.equal(await page.evaluate(() => !!document.activeElement.closest("#stage canvas")), true);
    await page.keyboard.press("?");
    await page.keyboard.press("Escape");
    assert.equal(await page.isVisible("#keys"), false);
    assert.deepEqual(page.errors, []);
  },

  async the_systems_colours_are_followed_until_one_chooses(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: program(0) });
    const theme = () => page.evaluate(() => document.documentElement.dataset.theme);
    assert.equal(await theme(), "light");
    await page.emulateMedia({ colorScheme: "dark" });
    await page.waitForFunction(() => document.documentElement.dataset.theme === "dark");
    await page.click("#theme");
    assert.equal(await theme(), "light");
    await page.emulateMedia({ colorScheme: "light" });
    await page.emulateMedia({ colorScheme: "dark" });
    await page.waitForTimeout(100);
    assert.equal(await theme(), "light");
    assert.deepEqual(page.errors, []);
  },

  async tabs_gauges_and_pictures_are_reached_by_the_keyboard(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: program(100) });
    await page.focus("#tab-console");
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.getAttribute("#tab-plots", "aria-selected"), "true");
    assert.equal(await page.evaluate(() => document.activeElement.id), "tab-plots");
    assert.equal(await page.getAttribute("#pane-plots", "role"), "tabpanel");
    assert.equal(await page.getAttribute("#console-lines", "role"), "log");
    await page.focus("#fan");
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction(() => /^ir1: \d+.counts/.test(document.querySelector("#fan + output").textContent));
    assert.match(await page.getAttribute("#fan", "aria-label"), /ir0 to ir7, counts: \d/);
    await page.keyboard.press("Enter");
    await until(page, "(app) => app.plots.names.join() === 'puck.ir1'");
    await page.locator(".gauge .name").first().focus();
    await page.keyboard.press("ArrowDown");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "battery");
    // a tool without a mouse
    await page.focus("#tool-box");
    await page.keyboard.press("Enter");
    await until(page, "(app) => app.world.things.length === 2");
    await page.waitForSelector('#tool-select[aria-pressed="true"]');  // with the answer, behind the world
    assert.deepEqual(page.errors, []);
  },

  async at_200_percent_everything_is_there(browser, live) {
    const [v, first] = await start(browser, live, kWorld, { drive: program(100) });
    await first.context().close();
    // a browser at 200 % has half as many pixels of CSS
    const page = await open(browser, v, { width: 640, height: 360 });
    const wide = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
    assert.ok(wide[0] <= wide[1], `no sideways scrolling: ${wide}`);
    for (const id of ["#play", "#save", "#tool-robot", "#stage canvas", "#scrub", "#tab-problems", "#console-input", "#pieces", "#selector"]) {
      await page.locator(id).first().scrollIntoViewIfNeeded();
      const box = await page.locator(id).first().boundingBox();
      assert.ok(box && box.width > 8 && box.x >= 0 && box.x + Math.min(box.width, 640) <= 641, `${id}: ${JSON.stringify(box)}`);
    }
    assert.ok((await page.locator("#stage").boundingBox()).height >= 200);
    await picture(page, "access_zoom");
    await page.evaluate(() => scrollTo(0, 0));
    await picture(page, "access_zoom_top");
    assert.deepEqual(page.errors, []);
  },

  async few_colours_show_which_tool_is_on(browser, live) {
    const [v, first] = await start(browser, live);
    await first.context().close();
    const page = await (await browser.newContext({ forcedColors: "active", viewport: { width: 1280, height: 720 } })).newPage();
    await page.goto(v.address);
    await page.waitForFunction(() => document.body.dataset.ready === "yes");
    const look = (id) => page.evaluate((id) => { const s = getComputedStyle(document.querySelector(id)); return s.backgroundColor + s.borderColor; }, id);
    assert.notEqual(await look("#tool-select"), await look("#tool-wall"));
    await page.click("#tool-wall");
    assert.notEqual(await look("#tool-wall"), await look("#tool-select"));
    assert.notEqual(await look("#tab-console"), await look("#tab-plots"));
    await picture(page, "access_forced");
  },

  async robots_have_the_colours_of_their_paths(browser, live) {
    const robots = ["", "", "colour = [0.9, 0.1, 0.1]\n"].map((more, i) => `[[robot]]\nname = "r${i}"\nfirmware = "drive"\nposition = [-0.3, ${0.2 - 0.2 * i}]\n${more}`).join("\n");
    const [, page] = await start(browser, live, `twinpuck = 1\n[arena]\nsize = [1, 1]\n${robots}`, { drive: program(100) });
    const colours = await ask(page, "(app) => app.world.robots.map((r, i) => [r.colour.map((v) => Math.round(255 * v)).join(), app.scene.paths.of(i).colour.getStyle().replace(/[^\\d,]/g, '')])");
    for (const [own, trail] of colours) assert.equal(own, trail);
    assert.equal(new Set(colours.map((c) => c[0])).size, 3);
    assert.equal(colours[2][0], "230,26,26");
  },
};
