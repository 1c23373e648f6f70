/* SPDX-License-Identifier: MIT
 * Distance sensors: the proximity ring ps0 to ps7, the ground sensors gs0 to gs2 where the robot carries
 * them, and virtual sensors that a supervisor defines (any other name it uses).
 * Numbering of the ring: key sensor_order of [webots]; "product" counts clockwise from the front right, "lab"
 * from the left.
 */
#ifndef WB_DISTANCE_SENSOR_H
#define WB_DISTANCE_SENSOR_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_distance_sensor_enable(WbDeviceTag tag, int sampling_period);
void wb_distance_sensor_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_distance_sensor_get_sampling_period(WbDeviceTag tag);

/** Counts. Ring: e_get_calibrated_prox(), 0 to 4095, more when near. Ground: 0 to 1000 or so, less on black.
 *  Virtual: what the supervisor says. NaN before the first period is over. Fresh once a period. Does not
 *  block. */
double wb_distance_sensor_get_value(WbDeviceTag tag);

/** 4095 and 0 of the ring, 1000 and 0 of ground sensors, counts. */
double wb_distance_sensor_get_max_value(WbDeviceTag tag);
double wb_distance_sensor_get_min_value(WbDeviceTag tag);

/** rad: 0.3 of the ring, 0 of others; the world's settings are not told to programs. [Webots: lab, I13] */
double wb_distance_sensor_get_aperture(WbDeviceTag tag);

/** The response curve belongs to the world's proximity profile and not to the program: no rows. */
int wb_distance_sensor_get_lookup_table_size(WbDeviceTag tag);
const double* wb_distance_sensor_get_lookup_table(WbDeviceTag tag);

typedef enum {
  WB_DISTANCE_SENSOR_GENERIC = 0,
  WB_DISTANCE_SENSOR_INFRA_RED,
  WB_DISTANCE_SENSOR_SONAR,
  WB_DISTANCE_SENSOR_LASER
} WbDistanceSensorType;

/** Infra-red of ring and ground, generic of virtual ones. */
WbDistanceSensorType wb_distance_sensor_get_type(WbDeviceTag tag);

TP_C_END

#endif
