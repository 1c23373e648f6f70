// SPDX-License-Identifier: MIT
// The console: bytes to the robot and from it (issue 38, 5).
import assert from "node:assert/strict";
import { ask, blind, picture, until } from "./harness.mjs";
import { kWorld, program, start } from "./worlds.mjs";

// says what it gets, as two hexadecimal digits a byte
const echo = `#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
int main(void) {
  char c, out[4];
  const char *digits = "0123456789abcdef";
  e_init_port();
  e_init_uart1();
  e_send_uart1_char("caf\\xc3\\xa9 \\x80\\x1b\\r\\n", 10);
  while (1) {
    if (!e_ischar_uart1()) continue;
    e_getchar_uart1(&c);
    out[0] = digits[(c >> 4) & 15];
    out[1] = digits[c & 15];
    out[2] = '.';
    e_send_uart1_char(out, 3);
    while (e_uart1_sending()) ;
  }
}
`;
const said = (page, text) => until(page, "(app, text) => document.querySelector('#console-lines').textContent.includes(text)", text);

export const tests = {
  async the_console_reads_utf_8_and_shows_other_bytes(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: echo });
    await blind(page);
    await page.click("#play");
    await said(page, "café \\x80\\x1b");
    await picture(page, "console_bytes");
  },

  async bytes_are_typed(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: echo });
    await blind(page);
    await page.click("#play");
    await said(page, "café");
    const send = async (text) => {
      await page.fill("#console-input", text);
      await page.press("#console-input", "Enter");
    };
    await page.selectOption("#line-end", "none");
    await send("\\x05\\0A");
    await said(page, "05.00.41.");
    await page.selectOption("#line-end", "LF");
    await send("B");
    await said(page, "42.0a.");
    await page.selectOption("#line-end", "none");
    await send("é");
    await said(page, "c3.a9.");
    await page.selectOption("#characters", "latin-1");
    await send("é\\xF5");
    await said(page, "e9.f5.");
    await send("€");
    await page.waitForFunction(() => /no byte in Latin-1/.test(document.querySelector("#notice").textContent));
    assert.equal(await page.inputValue("#console-input"), "€", "what was not sent stays");
    // what was chosen is remembered
    await page.reload();
    await page.waitForFunction(() => document.body.dataset.ready === "yes");
    assert.equal(await page.inputValue("#characters"), "latin-1");
    assert.equal(await page.inputValue("#line-end"), "none");
    assert.equal(await ask(page, "(app) => app.frames > -1"), true);
    assert.deepEqual(page.errors, []);
  },

  async the_end_is_followed_until_one_reads_what_is_above(browser, live) {
    const ticks = program(400).replace("rounds++;", 'rounds++; e_send_uart1_char("tick\\r\\n", 6);');
    const [, page] = await start(browser, live, kWorld, { drive: ticks });
    await blind(page);
    const lines = () => page.locator("#console-lines > div").count();
    const more = async () => {
      const before = await lines();
      await page.click("#play");
      for (const end = Date.now() + 20000; (await lines()) < before + 60 && Date.now() < end; ) await page.waitForTimeout(20);
      await page.click("#play");
      await until(page, "(app) => !app.state.playing");
      assert.ok((await lines()) >= before + 60);
    };
    const below = () => page.evaluate(() => { const l = document.getElementById("console-lines"); return l.scrollHeight - l.scrollTop - l.clientHeight; });
    await more();
    assert.ok((await page.evaluate(() => document.getElementById("console-lines").scrollTop)) > 200);
    assert.ok(Math.abs(await below()) < 2, "the end is in sight");
    await page.evaluate(() => { document.getElementById("console-lines").scrollTop = 10; });
    await more();
    assert.equal(await page.evaluate(() => document.getElementById("console-lines").scrollTop), 10, "what is read stays where it is");
    await page.evaluate(() => { const l = document.getElementById("console-lines"); l.scrollTop = l.scrollHeight; });
    await more();
    assert.ok(Math.abs(await below()) < 2, "the end is followed again");
    assert.deepEqual(page.errors, []);
  },
};
