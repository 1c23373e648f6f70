// SPDX-License-Identifier: MIT
// Programs: written, driven, watched.
import assert from "node:assert/strict";
import { ask, blind, until } from "./harness.mjs";
import { kWorld, program, start, x, time } from "./worlds.mjs";

export const tests = {
  async a_saved_program_runs_within_a_second_and_a_broken_one_does_not(browser, live) {
    // slow robots with room on both sides: a busy machine may take its time
    const [v, page] = await start(browser, live, kWorld.replace("[-0.4, 0]", "[0.2, 0]"), { drive: program(50) });
    await blind(page);
    await page.click("#play");
    await page.click("#tab-program");
    await until(page, "(app) => app.program.text().includes('e_set_speed_left')");
    await until(page, "(app) => app.frame.poses[0] > 0.203");
    const begin = Date.now();
    await ask(page, "(app, text) => { app.program.setText(text); return app.program.save(); }", program(-50));
    await page.waitForFunction(() => document.querySelector("#build-messages").dataset.ok === "true");
    const took = (Date.now() - begin) / 1000;
    console.log(`     the new program ran ${took.toFixed(2)} s after it was saved`);
    assert.ok(took < 5);
    const turned = await x(page);
    await until(page, "(app, x) => app.frame.poses[0] < x - 0.01", turned);
    v.write("drive/main.c", program(50).replace("int main", "int main nonsense"));
    await page.waitForFunction(() => document.querySelector("#build-messages").dataset.ok === "false");
    const still = await x(page);
    await until(page, "(app, x) => app.frame.poses[0] < x - 0.005", still);
    assert.ok(await page.locator("#source .cm-lintRange-error, #source .cm-lint-marker-error").count() > 0, "the message stands in its line");
  },

  async serial_console_and_selector(browser, live) {
    const [, page] = await start(browser, live);
    await page.click("#play");
    await page.waitForFunction(() => document.querySelector("#console-lines").textContent.includes("hello"));
    await page.fill("#console-input", "ping");
    await page.press("#console-input", "Enter");
    await page.waitForFunction(() => document.querySelector("#console-lines").textContent.includes("ping"));
    await page.fill("#selector", "5");
    await until(page, "(app) => (app.leds(0) & 255) === 32");
  },

  async registers_remote_control_and_battery(browser, live) {
    const remote = `#include <motor_led/e_init_port.h>
#include <motor_led/advance_one_timer/e_remote_control.h>
#include <motor_led/advance_one_timer/e_agenda.h>
volatile int pressed = -1;
int main(void) {
  e_init_port();
  e_init_remote_control();
  e_start_agendas_processing();
  while (1) if (e_get_data() == 5) pressed = 5;
}
`;
    const [v, page] = await start(browser, live, kWorld, { drive: remote });
    await ask(page, "(app) => app.togglePlay()");
    await page.fill("#watch", "pressed");
    await page.keyboard.press("Enter");
    await until(page, "(app) => app.values.get('puck.var:pressed') === -1");
    await ask(page, "() => document.querySelector('#hands button[title*=\"key 5\"]').click()");
    await until(page, "(app) => app.values.get('puck.var:pressed') === 5");
    await page.evaluate(() => { const b = document.getElementById("battery"); b.value = "3.2"; b.dispatchEvent(new Event("change")); });
    await until(page, "(app) => app.values.get('puck.battery') < 3.3");
    // registers: only where there is a chip
    const controller = "#include <webots/robot.h>\nint main(void) {\n  wb_robot_init();\n  while (wb_robot_step(32) != -1);\n  return 0;\n}\n";
    const [, bare] = await start(browser, live, kWorld, { drive: controller });
    assert.match(await ask(bare, "(app) => app.connection.ask('subscribe', { names: ['puck.reg:T2CON'] }).catch((e) => e.message)"), /without a chip/);
    const [, other] = await start(browser, live, kWorld, { drive: remote }, ["--hal", "dspic"]);
    await other.fill("#watch", "reg:T2CON");
    await other.keyboard.press("Enter");
    await ask(other, "(app) => app.togglePlay()");
    await until(other, "(app) => app.values.get('puck.reg:T2CON') >= 0x8000");
    assert.deepEqual(page.errors, []);
  },

  async what_a_robot_sees_hears_and_carries(browser, live) {
    const eye = `#include <camera/fast_2_timer/e_poxxxx.h>
#include <motor_led/e_init_port.h>
static char picture[2 * 40 * 30];
int main(void) {
  e_init_port();
  e_poxxxx_init_cam();
  e_poxxxx_config_cam(0, 0, 640, 480, 16, 16, RGB_565_MODE);
  e_poxxxx_write_cam_registers();
  while (1) {
    e_poxxxx_launch_capture(picture);
    while (!e_poxxxx_is_img_ready())
      ;
  }
}
`;
    const [, page] = await start(browser, live, kWorld + `
[[box]]
name = "red"
position = [-0.15, 0]
size = [0.02, 0.4, 0.1]
colour = [1, 0, 0]

[[sound]]
name = "horn"
kind = "tone"
position = [-0.4, 0.2, 0.035]
level = 80

[[lamp]]
name = "lamp"
position = [0.2, -0.2, 0.2]
attenuation = [0, 0, 1]
`, { drive: eye });
    await page.click("#play");
    await until(page, "(app) => app.look?.picture?.number > 2");
    // a red wall fills the middle
    const [r, g, b] = await page.evaluate(() => [...document.getElementById("camera").getContext("2d").getImageData(20, 15, 1, 1).data]);
    assert.ok(r > 80 && r > 3 * g && r > 3 * b, `${[r, g, b]}`);
    assert.equal(await ask(page, "(app) => app.scene.view.visible && app.scene.view.children.length"), 1);
    await page.keyboard.press("k");
    assert.equal(await ask(page, "(app) => app.scene.view.visible"), false);
    // it waits there, or in the camera's handler, whichever a look meets
    await until(page, `(app) => {
      const stands = document.getElementById("stands");
      if (stands.textContent === "waits in main(), main.c:11") stands.click();
      return app.program.markedLine === 11 &&
        document.querySelector("#source .cm-line.stands")?.textContent === "    while (!e_poxxxx_is_img_ready())";
    }`);
    await until(page, "(app) => Math.abs(app.values.get('puck.sound_bearing') - 90) < 5 && app.values.get('puck.mic_level1') > 50");
    // rings: of the sound's levels, and where the lamp's light is a half, a quarter, an eighth of that below it
    const rings = await ask(page, "(app) => app.world.things.map((t) => [t.kind, app.scene.things.get(t.id).children.length])");
    assert.deepEqual(rings.filter(([kind]) => kind === "lamp"), [["lamp", 6]]);
    assert.ok(rings.find(([kind]) => kind === "sound")[1] >= 3);
    // a part, plugged in before the run begins
    await page.click("#restart");
    await until(page, "(app) => app.frame.time === 0");
    await page.selectOption("#add-part", "lis-turret");
    await until(page, "(app) => app.world.robots[0].parts.join() === 'lis-turret' && app.scene.robots.turrets?.count === 1");
    await page.waitForFunction(() => /LEDs 00000/.test(document.querySelector("#parts").textContent));
    assert.deepEqual(page.errors, []);
  },

  async a_loudspeaker_that_sounds_is_seen(browser, live) {
    const [, page] = await start(browser, live, kWorld, { drive: `#include <codec/e_sound.h>
#include <motor_led/e_init_port.h>
int main(void) {
  e_init_port();
  e_init_sound();
  e_play_sound(0, 19044);
  while (1) ;
}
` });
    await page.click("#play");
    await until(page, "(app) => app.scene.robots.sounding?.count === 1 && app.values.get('puck.speaker') > 1");
    // the sound's last sample, at 7200 a second
    await until(page, "(app) => app.frame.time > 3");
    await until(page, "(app) => app.scene.robots.sounding?.count === 0 && app.values.get('puck.speaker') === 0");
  },
};
