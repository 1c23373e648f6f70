/* SPDX-License-Identifier: MIT
 * The basic proximity driver, for its two files on Timer 1 and Timer 2. The includer defines
 *   PROX_HANDLER          name of the interrupt handler
 *   PROX_CLEAR_FLAG()     clears the timer's flag
 *   PROX_SET_PERIOD(n)    writes its period register
 *   PROX_START()          prescaler 8, count 0, PULSE_COUNTS, interrupt on, timer on
 *   PROX_STOP()           timer off
 *
 *   interrupt   dark samples of a pair, LED on    350.5 us    lit samples, LED off    2100.2 us    next pair ...
 *
 * Source: [lib: a_d/e_prox.c, e_prox_timer2.c], facts restated.
 */
#ifndef HAL_DSPIC_BASIC_PROX_H
#define HAL_DSPIC_BASIC_PROX_H

#include "a_d/e_ad_conv.h"
#include "motor_led/e_epuck_ports.h"

#define SENSORS 8
#define PAIRS 4
#define PULSE_COUNTS 645 /* 350 us in units of 8 cycles */
#define REST_COUNTS 3870 /* 2100 us */

static int ambient[SENSORS];   /* dark */
static int reflected[SENSORS]; /* dark less lit */
static unsigned char pair;
static unsigned char is_lit;

static void switch_leds(unsigned char on) {
  switch (pair) {
    case 0:
      if (on) PULSE_IR0 = 1; else PULSE_IR0 = 0;
      break;
    case 1:
      if (on) PULSE_IR1 = 1; else PULSE_IR1 = 0;
      break;
    case 2:
      if (on) PULSE_IR2 = 1; else PULSE_IR2 = 0;
      break;
    default:
      if (on) PULSE_IR3 = 1; else PULSE_IR3 = 0;
  }
}

void __attribute__((__interrupt__, __auto_psv__)) PROX_HANDLER(void) {
  PROX_CLEAR_FLAG();
  if (is_lit) {
    reflected[pair] = ambient[pair] - e_read_ad(IR0 + pair);
    reflected[pair + PAIRS] = ambient[pair + PAIRS] - e_read_ad(IR4 + pair);
    switch_leds(0);
    PROX_SET_PERIOD(REST_COUNTS);
    pair = (pair + 1) % PAIRS;
    is_lit = 0;
  } else {
    ambient[pair] = e_read_ad(IR0 + pair);
    ambient[pair + PAIRS] = e_read_ad(IR4 + pair);
    switch_leds(1);
    PROX_SET_PERIOD(PULSE_COUNTS);
    is_lit = 1;
  }
}

void e_init_prox(void) {
  e_init_ad();
  PROX_START();
}

void e_stop_prox(void) {
  PROX_STOP();
  PULSE_IR0 = 0;
  PULSE_IR1 = 0;
  PULSE_IR2 = 0;
  PULSE_IR3 = 0;
}

int e_get_prox(unsigned int sensor_number) { return sensor_number < SENSORS ? reflected[sensor_number] : 0; }

int e_get_ambient_light(unsigned int sensor_number) {
  return sensor_number < SENSORS ? ambient[sensor_number] : 0;
}

#endif
