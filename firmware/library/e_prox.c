/* SPDX-License-Identifier: MIT
 * Proximity sensors, usual variant: values come from the ADC scan.
 * Source: [lib: a_d/advance_ad_scan/e_prox.c], facts restated.
 */
#include "a_d/advance_ad_scan/e_prox.h"

#include "hal.h"

#define CALIBRATION_ROUNDS 100
#define CALIBRATION_PAUSE_ROUNDS 1000 /* after each reading */

int hal_free_space[IR_CHANNELS]; /* readings with nothing near */

int e_get_prox(unsigned int sensor_number) {
  if (sensor_number >= IR_CHANNELS) return 0;
  return e_ambient_ir[sensor_number] - e_ambient_and_reflected_ir[sensor_number];
}

int e_get_calibrated_prox(unsigned int sensor_number) {
  int reading;
  if (sensor_number >= IR_CHANNELS) return 0;
  reading = e_get_prox(sensor_number) - hal_free_space[sensor_number];
  return reading > 0 ? reading : 0;
}

int e_get_ambient_light(unsigned int sensor_number) {
  if (sensor_number >= IR_CHANNELS) return 0;
  return e_ambient_ir[sensor_number];
}

void e_calibrate_ir() {
  long sum[IR_CHANNELS];
  int round;
  unsigned int sensor;
  for (sensor = 0; sensor < IR_CHANNELS; sensor++) {
    hal_free_space[sensor] = 0;
    sum[sensor] = 0;
  }
  for (round = 0; round < CALIBRATION_ROUNDS; round++) {
    /* as a for-loop, XC16's -O2 begins one element before the arrays and warns */
    sensor = 0;
    do {
      sum[sensor] += e_get_prox(sensor);
      hal_pause(CALIBRATION_PAUSE_ROUNDS);
    } while (++sensor < IR_CHANNELS);
  }
  for (sensor = 0; sensor < IR_CHANNELS; sensor++)
    hal_free_space[sensor] = (int)((float)sum[sensor] / CALIBRATION_ROUNDS);
}
