// SPDX-License-Identifier: MIT
// Programs for Webots' interfaces in the page.
import { ask, until } from "./harness.mjs";
import { kWorld, start, x } from "./worlds.mjs";

export const tests = {
  async a_program_for_webots_is_driven_and_rewritten(browser, live) {
    const drive = (speed) => `#include <stdio.h>
#include <math.h>
#include <webots/robot.h>
#include <webots/motor.h>
int main(void) {
  WbDeviceTag left, right;
  wb_robot_init();
  left = wb_robot_get_device("left wheel motor");
  right = wb_robot_get_device("right wheel motor");
  wb_motor_set_position(left, INFINITY);
  wb_motor_set_position(right, INFINITY);
  wb_motor_set_velocity(left, ${speed});
  wb_motor_set_velocity(right, ${speed});
  printf("speed ${speed}\\n");
  while (wb_robot_step(32) != -1);
  return 0;
}
`;
    const [v, page] = await start(browser, live, kWorld.replace("[-0.4, 0]", "[0.2, 0]"), { drive: drive(0.5) });
    await page.click("#play");
    await until(page, "(app) => app.frame.poses[0] > 0.203");
    await page.waitForFunction(() => document.querySelector("#console-lines").textContent.includes("speed 0.5"));
    await page.click("#tab-program");
    await until(page, "(app) => app.program.text().includes('wb_motor_set_velocity')");
    await ask(page, "(app, text) => { app.program.setText(text); return app.program.save(); }", drive(-0.5));
    await page.waitForFunction(() => document.querySelector("#build-messages").dataset.ok === "true");
    const turned = await x(page);
    await until(page, "(app, x) => app.frame.poses[0] < x - 0.003", turned);
    v.write("drive/main.c", drive(1).replace("int main", "int main nonsense"));
    await page.waitForFunction(() => document.querySelector("#build-messages").dataset.ok === "false");
  },
};
