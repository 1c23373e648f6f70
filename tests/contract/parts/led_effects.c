/* SPDX-License-Identifier: MIT
 * Effects of LEDs, a step a call and more than one round, and blinking by an agenda. */
#include "say.h"
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/e_epuck_ports.h>

static long ring(void) {
  return LED0 | LED1 << 1 | LED2 << 2 | LED3 << 3 | LED4 << 4 | LED5 << 5 | LED6 << 6 | (long)LED7 << 7;
}

static void steps(const char* name, void (*effect)(void), int count) {
  e_led_clear();
  while (count--) {
    effect();
    say(name, ring());
  }
}

int main(void) {
  int tenth, changes = 0;
  long before;
  begin();
  steps("flow", flow_led, 7);
  steps("snake", snake_led, 10);
  steps("k2000", k2000_led, 6);
  steps("right", right_led, 6);
  steps("left", left_led, 6);
  steps("blink", e_blink_led, 2);
  steps("blink0", e_blink_led0, 2);
  steps("blink1", e_blink_led1, 2);
  steps("blink2", e_blink_led2, 2);
  steps("blink3", e_blink_led3, 2);
  steps("blink4", e_blink_led4, 2);
  steps("blink5", e_blink_led5, 2);
  steps("blink6", e_blink_led6, 2);
  steps("blink7", e_blink_led7, 2);
  e_led_clear();
  e_start_agendas_processing();
  e_start_led_blinking(2000);
  before = ring();
  for (tenth = 0; tenth < 90; tenth++) {
    pause_ms(10);
    if (ring() != before) changes++;
    before = ring();
  }
  say("changes", changes);
  e_stop_led_blinking();
  e_led_clear();
  pause_ms(500);
  say("stopped", ring());
  end();
}
