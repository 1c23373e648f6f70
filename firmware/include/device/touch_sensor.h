/* SPDX-License-Identifier: MIT
 * Touch sensors, which the e-puck has not: virtual ones only.
 * Interface of 2005 to 2008; webots/touch_sensor.h has the present one and says more.
 */
#ifndef DEVICE_TOUCH_SENSOR_H
#define DEVICE_TOUCH_SENSOR_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void touch_sensor_enable(DeviceTag tag, int ms);
void touch_sensor_disable(DeviceTag tag);

/** What the supervisor says, cut to whole numbers; 0 before the first period is over. Does not block. */
unsigned short touch_sensor_get_value(DeviceTag tag);

TP_C_END

#endif
