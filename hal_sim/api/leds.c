/* SPDX-License-Identifier: MIT
 * The pins of the LEDs. Source of the pins: [lib: motor_led/e_epuck_ports.h], facts restated.
 */
#include "hal.h"
#include "hal_sim/api/takes.h"

#define FRONT_PIN 1 /* of port C */
#define BODY_PIN 2

static const unsigned char ring_pin[RING_LEDS] = {6, 7, 9, 12, 10, 13, 14, 15}; /* of port A */

/* a pin to 0, to 1, and toggled; the ring's is one of eight [measured: register way] */
static const unsigned char ring_cycles[3] = {24, 27, 29};
static const unsigned char other_cycles[3] = {10, 15, 17};

TAKES(0) static void set_pin(char port, unsigned char pin, unsigned int value, const unsigned char *cycles) {
  tp_spend(cycles[value > 1 ? 2 : value]);
  tp_latch_write(port, pin, value > 1 ? !tp_latch_read(port, pin) : value);
}

TAKES(0) void hal_set_ring(unsigned int led, unsigned int value) {
  set_pin('A', ring_pin[led], value, ring_cycles);
}

TAKES(0) void hal_note_led(unsigned int led) { tp_note_led(led); }

TAKES(0) void hal_set_front(unsigned int value) { set_pin('C', FRONT_PIN, value, other_cycles); }

TAKES(0) void hal_set_body(unsigned int value) { set_pin('C', BODY_PIN, value, other_cycles); }
