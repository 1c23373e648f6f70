/* SPDX-License-Identifier: MIT
 * The LED pins, for the three variants of e_led.
 *
 *   ring LED   0    1    2    3    4    5    6    7        front  body
 *   pin       RA6  RA7  RA9  RA12 RA10 RA13 RA14 RA15       RC1   RC2
 *
 * Source: [lib: motor_led/e_epuck_ports.h], facts restated.
 */
#ifndef TWINPUCK_API_LEDS_H
#define TWINPUCK_API_LEDS_H

#include "hal_sim/host/pins.h"

#define RING_LEDS 8
#define FRONT_PIN 1
#define BODY_PIN 2

static const unsigned char ring_pin[RING_LEDS] = {6, 7, 9, 12, 10, 13, 14, 15};

/** A pin of port A or C to bit 0 of `value`; above 1 toggles. */
static inline void set_pin(char port, unsigned char pin, unsigned int value) {
  tp_i64 level = value > 1 ? !tp_latch_read(port, pin) : value & 1;
  tp_latch_write(port, pin, level);
}

static inline void set_ring(unsigned int led, unsigned int value) { set_pin('A', ring_pin[led], value); }

#endif
