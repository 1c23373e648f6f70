/* SPDX-License-Identifier: MIT
 * Gyroscope, device "gyro", revision 1.3 only.
 * Interface of 2005 to 2008; webots/gyro.h has the present one and says more.
 */
#ifndef DEVICE_GYRO_H
#define DEVICE_GYRO_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void gyro_enable(DeviceTag tag, int ms);
void gyro_disable(DeviceTag tag);

/** Angular rates about x, y, z, scaled as in webots/gyro.h. Valid until the
 *  next step; zeros before the first period is over. Does not block. */
const float* gyro_get_values(DeviceTag tag);

/** Parts of such values. */
#define gyro_value_x(values) ((values)[0])
#define gyro_value_y(values) ((values)[1])
#define gyro_value_z(values) ((values)[2])
TP_C_END

#endif
