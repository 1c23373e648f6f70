/* SPDX-License-Identifier: MIT
 * Compass, a device that the world file adds.
 * Interface of 2005 to 2008; webots/compass.h has the present one and says more.
 */
#ifndef DEVICE_COMPASS_H
#define DEVICE_COMPASS_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void compass_enable(DeviceTag tag, int ms);
void compass_disable(DeviceTag tag);

/** Unit vector to the north, as in webots/compass.h. Valid until the
 *  next step; zeros before the first period is over. Does not block. */
const float* compass_get_values(DeviceTag tag);

/** Parts of such values. */
#define compass_value_x(values) ((values)[0])
#define compass_value_y(values) ((values)[1])
#define compass_value_z(values) ((values)[2])
TP_C_END

#endif
