/* SPDX-License-Identifier: MIT
 * Accelerometer, device "accelerometer".
 * Interface of 2005 to 2008; webots/accelerometer.h has the present one and says more.
 */
#ifndef DEVICE_ACCELEROMETER_H
#define DEVICE_ACCELEROMETER_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void accelerometer_enable(DeviceTag tag, int ms);
void accelerometer_disable(DeviceTag tag);

/** x, y, z in m/s2, axes as in webots/accelerometer.h. Valid until the
 *  next step; zeros before the first period is over. Does not block. */
const float* accelerometer_get_values(DeviceTag tag);

/** Parts of such values. */
#define accelerometer_value_x(values) ((values)[0])
#define accelerometer_value_y(values) ((values)[1])
#define accelerometer_value_z(values) ((values)[2])
TP_C_END

#endif
