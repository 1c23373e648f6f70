/* SPDX-License-Identifier: MIT
 * LEDs as the ports have them. */
#include "say.h"
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/e_epuck_ports.h>

static long ring(void) {
  return LED0 | LED1 << 1 | LED2 << 2 | LED3 << 3 | LED4 << 4 | LED5 << 5 | LED6 << 6 | (long)LED7 << 7;
}

int main(void) {
  begin();
  say("dark", ring());
  e_set_led(3, 1);
  say("one", ring());
  e_set_led(3, 2);
  e_set_led(6, 2);
  say("toggled", ring());
  e_set_led(8, 1);
  say("all", ring());
  e_led_clear();
  say("none", ring());
  e_set_body_led(1);
  e_set_front_led(1);
  say("body", BODY_LED);
  say("front", FRONT_LED);
  e_set_body_led(2);
  say("body", BODY_LED);
  end();
}
