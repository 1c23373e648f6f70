// SPDX-License-Identifier: MIT
// Worlds and programs of the tests, and what most of them do with a page.
import { ask, open, until, view } from "./harness.mjs";

export const kWorld = `# a driver and a wall
twinpuck = 1
[arena]
size = [1.0, 1.0]

[[box]] # the wall
name = "wall"
position = [0.30, 0.30]
size = [0.02, 0.30, 0.1]

[[robot]]
name = "puck"
firmware = "drive"
position = [-0.4, 0]
`;
export const program = (speed) => `#include <motor_led/e_init_port.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <uart/e_uart_char.h>

volatile int rounds;
static int selector(void) { return SELECTOR0 + 2 * SELECTOR1 + 4 * SELECTOR2 + 8 * SELECTOR3; }

int main(void) {
  char c;
  long i;
  e_init_port();
  e_init_uart1();
  e_init_motors();
  e_start_agendas_processing();
  e_send_uart1_char("hello\\r\\n", 7);
  while (1) {
    e_set_speed_left(${speed});
    e_set_speed_right(${speed});
    for (i = 0; i < 8; i++) e_set_led(i, i == selector());
    if (e_ischar_uart1()) {
      e_getchar_uart1(&c);
      e_send_uart1_char(&c, 1);
    }
    rounds++;
    for (i = 0; i < 10000; i++) asm("nop");
  }
}
`;

/** So many robots in rows. */
export function swarm(n) {
  const row = Math.ceil(Math.sqrt(n)), side = row * 0.15, at = (i) => ((i + 0.5) * 0.15 - side / 2).toFixed(3);
  return `twinpuck = 1\n[arena]\nsize = [${side}, ${side}]\n` +
    Array.from({ length: n }, (_, i) => `[[robot]]\nname = "r${i}"\nfirmware = "drive"\nposition = [${at(i % row)}, ${at(Math.floor(i / row))}]\n`).join("");
}

/** A view and a page of it; both end with the test. A broken world does not run, so no frame comes. */
export async function start(browser, live, world = kWorld, programs = { drive: program(400) }, more = [], size = undefined, broken = false) {
  const v = await view(world, programs, more);
  live.push(v);
  return [v, await open(browser, v, size, "light", !broken)];
}
export const x = (page, body = 0) => ask(page, "(app, b) => app.frame.poses[4 * b]", body);
export const time = (page) => ask(page, "(app) => app.frame.time");
export const steps = async (page, count) => {
  const before = await time(page);
  await ask(page, "(app, count) => app.do('step', { unit: 'control', count })", count);
  await until(page, "(app, t) => app.frame.time > t", before + 0.031 * count);
};
