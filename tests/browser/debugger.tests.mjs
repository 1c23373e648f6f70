// SPDX-License-Identifier: MIT
// The debugger in the page (issue 38, 8).
import assert from "node:assert/strict";
import { ask, picture, until } from "./harness.mjs";
import { kWorld, start } from "./worlds.mjs";

const counts = `#include <motor_led/e_init_port.h>
volatile int rounds;
static int twice(int n) {
  int result = n + n;
  return result;
}
int main(void) {
  int k = 0;
  e_init_port();
  while (1) {
    k = twice(rounds);
    rounds = rounds + 1;
    if (k > 2000) rounds = 0;
  }
}
`;
const lineOf = (text) => counts.split("\n").findIndex((l) => l.includes(text)) + 1;
const stands = (page, line) => until(page, "(app, line) => app.debug.stands && app.program.markedLine === line", line);

export const tests = {
  async a_program_is_debugged_in_the_page(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: counts });
    const knows = await ask(page, "(app) => app.connection.ask('debug', { robot: '' }).then(() => true, (e) => !/expected a request/.test(e.message))");
    if (!knows) return console.log("     the server has no debugger in the page yet");
    await page.click("#tab-program");
    await until(page, "(app) => app.program.text().includes('twice')");
    // a breakpoint in the margin, one with a condition
    const margin = (line) => page.locator(".cm-breakpoints .cm-gutterElement").nth(line);
    await margin(lineOf("rounds = rounds + 1")).click();
    await page.waitForSelector(".breakpoint");
    await page.click("#debug-begin");
    await until(page, "(app) => app.debug.debugged === 'puck' && app.debug.stands");
    await page.click("#debug-continue");
    await stands(page, lineOf("rounds = rounds + 1"));
    await picture(page, "debugger_stands");
    assert.match(await page.textContent("#debug-calls"), /main/);
    assert.match(await page.textContent("#debug-variables"), /rounds/);
    await page.fill("#debug-watch", "rounds");
    await page.press("#debug-watch", "Enter");
    const rounds = () => ask(page, "(app) => Number(app.debug.watches[0].value.split(' ')[0])");
    await until(page, "(app) => app.debug.watches[0]?.value !== ''");
    const first = await rounds();
    await page.keyboard.press("Escape");
    await page.click("#debug-continue");
    await until(page, "(app, first) => app.debug.stands && Number(app.debug.watches[0].value.split(' ')[0]) === first + 1", first);
    // back to where it stood before
    await page.click("#debug-reverseContinue");
    await until(page, "(app, first) => app.debug.stands && Number(app.debug.watches[0].value.split(' ')[0]) === first", first);
    await page.click("#debug-next");
    await until(page, "(app, line) => app.debug.stands && app.debug.reason === 'step' && app.program.markedLine !== line", lineOf("rounds = rounds + 1"));
    await page.click("#debug-stepBack");
    await stands(page, lineOf("rounds = rounds + 1"));
    // a condition, by a right click
    await margin(lineOf("rounds = rounds + 1")).click({ button: "right" });
    await page.fill("#question-text", `rounds == ${first + 20}`);
    await page.press("#question-text", "Enter");
    await page.waitForSelector(".breakpoint.conditional");
    await page.click("#debug-continue");
    await until(page, "(app, want) => app.debug.stands && Number(app.debug.watches[0].value.split(' ')[0]) === want", first + 20);
    await page.click("#debug-why");
    await until(page, "(app) => app.debug.output.length > 1");
    await picture(page, "debugger_why");
    await page.click("#debug-begin");
    await until(page, "(app) => !app.state.debugging && app.debug.debugged === ''");
    await page.click("#play");
    const t = await ask(page, "(app) => app.frame.time");
    await until(page, "(app, t) => app.frame.time > t", t);
    // breakpoints are there after a reload
    await page.reload();
    await page.waitForFunction(() => document.body.dataset.ready === "yes");
    assert.equal(await ask(page, "(app) => app.debug.files().length"), 1);
    assert.deepEqual(page.errors, []);
  },
};
