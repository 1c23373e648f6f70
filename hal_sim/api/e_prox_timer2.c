/* SPDX-License-Identifier: MIT
 * Proximity sensors, basic variant on Timer 2.
 * The state machine of the timer is the board's (hal_sim/board/basic_prox.h).
 * Source: [lib: a_d/e_prox_timer2.c], facts restated.
 */
#define E_PROX_TIMER2
#include "a_d/e_prox.h"

#include "a_d/e_ad_conv.h"
#include "hal_sim/host/pins.h"

#define SENSORS 8

void e_init_prox(void) {
  e_init_ad();
  tp_basic_prox_start();
}

void e_stop_prox(void) { tp_basic_prox_stop(); }

int e_get_prox(unsigned int sensor_number) {
  return sensor_number < SENSORS ? (int)tp_basic_prox_reflected(sensor_number) : 0;
}

int e_get_ambient_light(unsigned int sensor_number) {
  return sensor_number < SENSORS ? (int)tp_basic_prox_ambient(sensor_number) : 0;
}
