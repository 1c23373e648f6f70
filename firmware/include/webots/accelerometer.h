/* SPDX-License-Identifier: MIT
 * Accelerometer, device "accelerometer".
 */
#ifndef WB_ACCELEROMETER_H
#define WB_ACCELEROMETER_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_accelerometer_enable(WbDeviceTag tag, int sampling_period);
void wb_accelerometer_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_accelerometer_get_sampling_period(WbDeviceTag tag);

/** Three values in m/s2, valid until the next step; at rest 9.81 upwards. Axes as the robot's in the world
 * file's convention (key axes of [webots]): enu forward, left, up; nue right, up, backward. NaN before the
 * first period is over. Does not block; about 1 ms a step on revision 1.3. */
const double* wb_accelerometer_get_values(WbDeviceTag tag);

/** The response curve belongs to the world's proximity profile and not to the program: no rows. */
int wb_accelerometer_get_lookup_table_size(WbDeviceTag tag);
const double* wb_accelerometer_get_lookup_table(WbDeviceTag tag);

TP_C_END

#endif
