// SPDX-License-Identifier: MIT
// What is looked at: paths, cameras, ruler, pictures and films, what the drawing leaves out, plots and time line with
// one cursor, decoders.
import assert from "node:assert/strict";
import fs from "node:fs";
import { ask, at, until } from "./harness.mjs";
import { start, time } from "./worlds.mjs";

// a robot that turns round a wall again and again
const kRound = `twinpuck = 1
[arena]
size = [1.0, 1.0]
[[wall]]
points = [[-0.25, 0.05], [0.25, 0.05]]
thickness = 0.01
[[robot]]
name = "puck"
firmware = "obstacle"
position = [-0.3, -0.2]
`;
const talker = `#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <uart/e_uart_char.h>
int main(void) {
  long i;
  e_init_port();
  e_init_uart1();
  while (1) {
    e_send_uart1_char("llama\\r\\n", 7);
    e_set_led(0, 1);
    for (i = 0; i < 2000; i++) asm("nop");
    e_set_led(0, 0);
    for (i = 0; i < 6000; i++) asm("nop");
  }
}
`;

export const tests = {
  async a_path_at_full_speed_goes_through_no_wall(browser, live) {
    const [, page] = await start(browser, live, kRound, {});
    await page.selectOption("#speed", "0");
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 400", null, 60000);
    await page.click("#play");
    await until(page, "(app) => !app.state.playing");
    const pieces = await ask(page, "(app) => app.scene.paths.pieces(0)");
    assert.ok(pieces.length > 5);
    const side = (p, q, x, y) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    const [a, b] = [[-0.25, 0.05], [0.25, 0.05]];
    for (const [x0, y0, x1, y1] of pieces) {
      const crosses = side(a, b, x0, y0) * side(a, b, x1, y1) < 0 && side([x0, y0], [x1, y1], ...a) * side([x0, y0], [x1, y1], ...b) < 0;
      assert.ok(!crosses, `through the wall: ${x0} ${y0} to ${x1} ${y1}`);
      assert.ok(Math.hypot(x1 - x0, y1 - y0) < 0.04, "by distance, not by frame");
    }
    assert.deepEqual(page.errors, []);
  },

  async cameras_go_with_a_robot_and_behind_it(browser, live) {
    const [, page] = await start(browser, live);
    const target = () => ask(page, "(app) => app.scene.controls.target.toArray()");
    await page.click("#follow");
    assert.equal(await page.getAttribute("#follow", "aria-pressed"), "true");
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 1");
    await page.click("#play");
    await until(page, "(app) => !app.state.playing");
    const robot = await ask(page, "(app) => [...app.frame.poses.subarray(0, 2)]");
    (await target()).slice(0, 2).forEach((v, i) => assert.ok(Math.abs(v - robot[i]) < 1e-3));
    await page.keyboard.press("4");
    const camera = await ask(page, "(app) => app.scene.camera.position.toArray()");
    assert.ok(camera[0] < robot[0] - 0.3 && camera[2] > 0.1, `behind a robot that looks east: ${camera}`);
    await page.click("#above");
    assert.equal(await page.getAttribute("#behind", "aria-pressed"), "false");
    assert.ok((await ask(page, "(app) => app.scene.camera.position.z")) > 1);
    assert.deepEqual(page.errors, []);
  },

  async the_ruler_measures_metres_and_degrees(browser, live) {
    const [, page] = await start(browser, live);
    await page.click("#measure");
    for (const place of [[0, -0.3], [0.3, -0.0001]]) {
      const p = await at(page, ...place);
      await page.mouse.click(p.x, p.y);
    }
    // 0.3 to the east, 0.3 to the north
    const [, metres, degrees] = (await page.textContent("#ruler")).match(/^([\d.]+)\s*m\s+([\d.]+)°/);
    assert.ok(Math.abs(metres - 0.424) < 0.006 && Math.abs(degrees - 45) < 1, `${metres} ${degrees}`);
    assert.equal(await ask(page, "(app) => app.selected"), await ask(page, "(app) => app.world.robots[0].id"), "nothing else is picked");
    await page.keyboard.press("m");
    assert.equal(await page.isVisible("#ruler"), false);
    // by keys alone: two pieces, the robot at (-0.4, 0) and the box at (0.3, 0.3)
    await ask(page, "(app) => app.store.selectAll([app.world.robots[0].id, app.world.things[0].id])");
    await page.keyboard.press("m");
    assert.match(await page.textContent("#ruler"), /^0\.762\s*m\s+23\.2°/);
    assert.deepEqual(page.errors, []);
  },

  async a_picture_and_a_film_are_downloaded(browser, live) {
    const [v, page] = await start(browser, live);
    const saved = async (id) => {
      const [file] = await Promise.all([page.waitForEvent("download", { timeout: 90000 }), page.click(id, { timeout: 90000 })]);
      await file.saveAs(`${v.folder}/saved`);
      return [file.suggestedFilename(), fs.readFileSync(`${v.folder}/saved`)];
    };
    const [name, png] = await saved("#picture");
    assert.equal(name, "world-0.000s.png");
    assert.equal(png.subarray(1, 4).toString(), "PNG");
    assert.ok(png.length > 3000, `${png.length} bytes: not an empty picture`);
    await page.click("#film");
    assert.match(await page.textContent("#film"), /Stop/);
    await page.click("#play");
    await until(page, "(app) => app.frame.time > 0.5");
    await ask(page, "(app) => { app.do('pause'); }");
    await until(page, "(app) => !app.state.playing");
    const [film, webm] = await saved("#film");
    assert.match(film, /^world-[\d.]+s\.webm$/);
    assert.doesNotMatch(await page.textContent("#film"), /Stop/);
    assert.equal(webm.readUInt32BE(0), 0x1a45dfa3, "EBML");
    assert.ok(webm.length > 2000);
    assert.deepEqual(page.errors, []);
  },

  async what_the_drawing_leaves_out_is_said_and_can_be_switched(browser, live) {
    const [, page] = await start(browser, live);
    await ask(page, "(app) => { app.scene.setDrawing(false); app.scene.canvas.setMeasures(true); }");
    assert.equal(await page.isVisible("#drawing-note"), false);
    await ask(page, "(app) => { const { canvas } = app.scene; for (let i = 0; canvas.quality.level < 2; ++i) if (canvas.quality.took(80, i)) canvas.requality(); }");
    assert.equal(await page.textContent("#drawing-note"), "Fast drawing: without shadows, antialiasing");
    await page.click("#drawing-note");
    assert.equal(await page.textContent("#drawing-note"), "Full drawing, however slow");
    assert.equal(await ask(page, "(app) => app.scene.canvas.quality.leftOut.length"), 0);
    await page.click("#drawing-note");
    assert.equal(await page.isVisible("#drawing-note"), false);
    assert.deepEqual(page.errors, []);
  },

  async plots_have_an_axis_a_unit_and_all_panes_one_cursor(browser, live) {
    const [, page] = await start(browser, live);
    await ask(page, "(app) => app.scene.setDrawing(false)");
    for (const name of ["ir0", "battery", "x"]) await ask(page, "(app, n) => app.plots.toggle(n)", `puck.${name}`);
    await ask(page, "(app) => { app.do('play'); }");
    await until(page, "(app) => app.frame.time > 1");
    await ask(page, "(app) => { app.do('pause'); }");
    await until(page, "(app) => !app.state.playing");
    assert.equal(await ask(page, "(app) => app.plots.chart.axes.length"), 4, "time, counts, V, m");
    const area = await page.locator("#plot .u-over").boundingBox();
    const press = (share) => page.mouse.click(area.x + share * area.width, area.y + 20);
    await page.mouse.move(area.x + 0.5 * area.width, area.y + 20);
    await until(page, "(app) => app.store.cursor.time > 0");
    assert.match(await ask(page, "(app) => app.plots.text()"), /^[\d.]+\s*s, puck\.ir0 \d+\s*counts, puck\.battery \d\.\d\d\s*V, puck\.x -?\d\.\d{3}\s*m$/);
    await press(0.25);
    await page.keyboard.down("Shift");
    await press(0.75);
    await page.keyboard.up("Shift");
    assert.match(await page.textContent("#pane-plots .markers-text"), /^A [\d.]+\s*s {2}B [\d.]+\s*s {2}B−A \d+\.\d+\s*m?s, [\d.]+\s*Hz$/);
    // the console marks the line that had been said by then
    await page.mouse.move(600, 5);
    await ask(page, "(app) => { app.showDock('console'); app.store.cursor.pointAt(0.5); }");
    assert.match(await page.textContent("#console-lines .cursor"), /hello/);
    // by keys
    await ask(page, "(app) => app.showDock('plots')");
    await page.focus("#plot");
    await page.keyboard.press("Home");
    assert.equal(await ask(page, "(app) => app.store.cursor.time"), await ask(page, "(app) => app.plots.times[0]"));
    assert.deepEqual(page.errors, []);
  },

  async uart_and_pwm_are_decoded(browser, live) {
    const [, page] = await start(browser, live, undefined, { drive: talker });
    await ask(page, "(app) => { app.scene.setDrawing(false); app.select(app.world.robots[0].id); }");
    await page.click("#tab-timeline");
    await page.fill("#signals", "TX1 LED0");
    await page.press("#signals", "Enter");
    await until(page, "(app) => app.timeline.names.length === 3");
    await ask(page, "(app) => { app.do('play'); }");
    await until(page, "(app) => app.timeline.known.changes[0] > 20");
    await ask(page, "(app) => { app.do('pause'); }");
    await until(page, "(app) => !app.state.playing");
    await page.selectOption('[aria-label="How TX1 is read"]', "UART");
    await page.selectOption('[aria-label="How LED0 is read"]', "PWM");
    const read = await ask(page, "(app) => { const rows = app.timeline.rows(), of = (n) => app.timeline.decodedOf(rows.find((r) => r.name === n)); return [of('TX1').bytes.slice(0, 7).map((b) => b.value), of('LED0').pulses.slice(1, 3)]; }");
    assert.equal(String.fromCharCode(...read[0]), "llama\r\n");
    // a quarter of the time between is that of the two loops; the bytes add to the low part
    for (const p of read[1]) assert.ok(p.high / (p.to - p.from) > 0.1 && p.high / (p.to - p.from) < 0.3, JSON.stringify(p));
    // a page that comes again reads them so, too
    assert.match(await page.evaluate(() => localStorage.getItem("decoders")), /TX1/);
    assert.deepEqual(page.errors, []);
  },
};
