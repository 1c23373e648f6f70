/* SPDX-License-Identifier: MIT
 * Light sensors ls0 to ls7.
 * Interface of 2005 to 2008; webots/light_sensor.h has the present one and says more.
 */
#ifndef DEVICE_LIGHT_SENSOR_H
#define DEVICE_LIGHT_SENSOR_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void light_sensor_enable(DeviceTag tag, int ms);
void light_sensor_disable(DeviceTag tag);

/** Counts, 0 to 4095: nearly 4095 in the dark, less with light. 0 before the first period is over. Does not
 *  block. */
unsigned short light_sensor_get_value(DeviceTag tag);

TP_C_END

#endif
