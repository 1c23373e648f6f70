/* SPDX-License-Identifier: MIT
 * Distance sensors: ps0 to ps7, gs0 to gs2 and virtual ones.
 * Interface of 2005 to 2008; webots/distance_sensor.h has the present one and says more.
 */
#ifndef DEVICE_DISTANCE_SENSOR_H
#define DEVICE_DISTANCE_SENSOR_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void distance_sensor_enable(DeviceTag tag, int ms);
void distance_sensor_disable(DeviceTag tag);

/** Counts, 0 to 4095 of the ring, more when near; fractions are cut. 0 before the first period is over. Does
 * not block. */
unsigned short distance_sensor_get_value(DeviceTag tag);

TP_C_END

#endif
