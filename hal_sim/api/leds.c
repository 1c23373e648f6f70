/* SPDX-License-Identifier: MIT
 * The pins of the LEDs. Source of the pins: [lib: motor_led/e_epuck_ports.h], facts restated.
 */
#include "hal.h"
#include "hal_sim/api/takes.h"

#define FRONT_PIN 1 /* of port C */
#define BODY_PIN 2

static const unsigned char ring_pin[RING_LEDS] = {6, 7, 9, 12, 10, 13, 14, 15}; /* of port A */

/* to 0, to 1, and toggled; a pin of the ring is one of eight */
#define RING_CYCLES(value) ((value) > 1 ? T_RING_TOGGLE : (value) ? T_RING_ON : T_RING_OFF)
#define OTHER_CYCLES(value) ((value) > 1 ? T_LED_TOGGLE : (value) ? T_LED_ON : T_LED_OFF)

TAKES(0) static void set_pin(char port, unsigned char pin, unsigned int value) {
  tp_latch_write(port, pin, value > 1 ? !tp_latch_read(port, pin) : value);
}

TAKES(0) void hal_set_ring(unsigned int led, unsigned int value) {
  tp_spend(RING_CYCLES(value));
  set_pin('A', ring_pin[led], value);
}

TAKES(0) void hal_set_rings(unsigned int value) {
  unsigned char led;
  tp_spend(value > 1 ? T_RINGS_TOGGLE : value ? T_RINGS_ON : T_RINGS_OFF);
  for (led = 0; led < RING_LEDS; led++) set_pin('A', ring_pin[led], value);
}

TAKES(0) void hal_note_led(unsigned int led) { tp_note_led(led); }

TAKES(0) void hal_set_front(unsigned int value) {
  tp_spend(OTHER_CYCLES(value));
  set_pin('C', FRONT_PIN, value);
}

TAKES(0) void hal_set_body(unsigned int value) {
  tp_spend(OTHER_CYCLES(value));
  set_pin('C', BODY_PIN, value);
}
