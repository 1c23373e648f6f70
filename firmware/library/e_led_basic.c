/* SPDX-License-Identifier: MIT
 * LEDs, basic variant: "all" toggles each LED by itself.
 */
#include "hal.h"
#include "motor_led/e_led.h"

void e_set_led(unsigned int led_number, unsigned int value) {
  if (led_number < RING_LEDS) {
    hal_set_ring(led_number, value);
    return;
  }
  hal_set_rings(value);
}

void e_led_clear(void) {
  hal_set_rings(0);
}

void e_set_body_led(unsigned int value) { hal_set_body(value); }

void e_set_front_led(unsigned int value) { hal_set_front(value); }
