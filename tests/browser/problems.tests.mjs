// SPDX-License-Identifier: MIT
// What is wrong is said, where it is.
import assert from "node:assert/strict";
import { ask, at, drag, picture, until } from "./harness.mjs";
import { kWorld, program, start } from "./worlds.mjs";

export const tests = {
  async problems_stand_beside_what_they_are_about(browser, live) {
    const [, page] = await start(browser, live);
    const wall = await ask(page, "(app) => app.world.things[0].id");
    await ask(page, "(app, id) => app.set(id, { size: [-1, 0.3, 0.1] })", wall);
    await page.waitForSelector("#badges button");
    assert.match(await page.textContent("#badges button"), /box\.size/);
    await page.click("#badges button");
    assert.equal(await ask(page, "(app) => app.selected"), wall);
    await page.keyboard.press("Escape");
    await page.click("#undo");
    await page.waitForFunction(() => document.querySelectorAll("#badges button").length === 0);
  },

  async a_trap_is_told(browser, live) {
    const programs = { drive: "int zero;\nint main(void) {\n  return 1 / zero;\n}\n" };
    const [, page] = await start(browser, live, kWorld, programs);
    await page.click("#play");
    const isTold = () => /math error.*main.c:3/.test(document.querySelector("#pane-problems").textContent);
    await page.waitForFunction(isTold);
    assert.equal(await page.textContent("#stopped"), "");  // the chip goes on behind it
    const stands = "#include <p30F6014A.h>\n_FOSC(CSW_FSCM_OFF & EC_PLL8);  // a clock that the robot has not\nint main(void) { while (1); }\n";
    const [, other] = await start(browser, live, kWorld, { drive: stands });
    await other.click("#play"); await other.waitForFunction(() => document.querySelector("#stopped").textContent === "1 stopped");
    await other.waitForFunction(() => /FOSC/.test(document.querySelector("#pane-problems").textContent));
  },

  async a_program_that_waits_for_ever_says_for_what_and_who_writes_it(browser, live) {
    // bytes on the serial line interrupt it, which is no help
    const waits = `#include <p30F6014A.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>
volatile int flag, never;
void __attribute__((interrupt, auto_psv)) _T3Interrupt(void) { IFS0bits.T3IF = 0; flag = 1; }
int main(void) {
  e_init_port();
  e_init_uart1();
  TMR3 = 0;
  while (flag == 0);
  while (!never);
  return 0;
}
`;
    for (const hal of ["sim", "dspic"]) {
      const [, page] = await start(browser, live, kWorld, { drive: waits }, ["--hal", hal]);
      await page.click("#play");
      await page.waitForFunction(() => /endless wait/.test(document.querySelector("#pane-problems").textContent));
      const told = await page.textContent("#pane-problems");
      assert.match(told, /main\.c:10.*waits here for .flag.; nothing will ever set it: only _T3Interrupt\(\) \(main.c:5\) could, and its interrupt is not enabled/, hal);
      await page.context().close();
    }
  },

  async problems_are_all_there_with_their_lines(browser, live) {
    const broken = program(100).replace("int main(void) {", "int main(void) {\n  int unused;\n  nonsense;\n  more_nonsense;");
    const [v, page] = await start(browser, live, kWorld, { drive: program(100) });
    await page.click("#tab-problems");
    assert.match(await page.textContent("#pane-problems"), /Nothing is wrong/);
    v.write("drive/main.c", broken);
    await page.waitForFunction(() => /more_nonsense/.test(document.querySelector("#pane-problems").textContent), undefined, { timeout: 30000 });
    const said = await page.textContent("#pane-problems");
    assert.doesNotMatch(said, /Nothing is wrong/);
    assert.match(said, /drive: main\.c:\d+(:\d+)?: .*nonsense/);
    await picture(page, "problems_compiler");
    // a click goes to the line
    await page.click("#pane-problems button:has-text('more_nonsense')");
    await page.waitForFunction(() => document.querySelector("#tab-program").getAttribute("aria-selected") === "true");
    const line = await ask(page, "(app) => { const v = app.program.editor.view; return v.state.doc.lineAt(v.state.selection.main.head).text; }");
    assert.match(line, /more_nonsense/);
    // mended: nothing is wrong any more
    v.write("drive/main.c", program(100));
    await page.waitForFunction(() => /Nothing is wrong/.test(document.querySelector("#pane-problems").textContent), undefined, { timeout: 30000 });
    assert.deepEqual(page.errors, []);
  },

  async a_robot_that_does_not_fit_is_hatched_where_the_file_says(browser, live) {
    // in the wall, from the beginning: there is no run at all
    const [, page] = await start(browser, live, kWorld.replace("[-0.4, 0]", "[0.27, 0.30]"), { drive: program(100) }, [], undefined, true);
    await page.waitForFunction(() => document.querySelectorAll("#badges button").length > 0);
    const robot = await ask(page, "(app) => { const r = app.world.robots[0]; return [r.position[0], r.position[1], r.body]; }");
    assert.deepEqual(robot.slice(0, 2), [0.27, 0.3]);
    if (robot[2] !== -1) return console.log("     the server says no bodies of -1 yet");
    await page.click("#tab-problems");
    assert.doesNotMatch(await page.textContent("#pane-problems"), /Nothing is wrong/);
    await page.waitForTimeout(500);
    await picture(page, "problems_hatched");
    // it can be picked and dragged to where it fits
    const p = await at(page, 0.25, 0.3, 0.05);
    await page.mouse.click(p.x, p.y);
    assert.equal(await ask(page, "(app) => app.selectedRobot()?.name ?? ''"), "puck");
    await drag(page, [0.25, 0.3, 0.05], [-0.2, -0.2, 0.05]);
    await until(page, "(app) => app.world.robots[0].position[0] < 0 && app.world.robots[0].body === 0");
    assert.deepEqual(page.errors, []);
  },
};
