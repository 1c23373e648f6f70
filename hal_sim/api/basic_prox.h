/* SPDX-License-Identifier: MIT
 * Proximity sensors of the basic variants, which differ in their timer only. Included once a variant, after
 * its e_prox.h. The state machine of the timer is the board's (hal_sim/board/basic_prox.h).
 */
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
