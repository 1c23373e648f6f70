/* SPDX-License-Identifier: MIT
 * Gyroscope, device "gyro": revision 1.3 only.
 */
#ifndef WB_GYRO_H
#define WB_GYRO_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_gyro_enable(WbDeviceTag tag, int sampling_period);
void wb_gyro_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_gyro_get_sampling_period(WbDeviceTag tag);

/** Angular rates about the three axes, valid until the next step; axes as of the accelerometer. Unit rad/s
 * times 7509.9, the scale of Webots' e-puck [Webots: E-puck.proto, lookup table 13.315805 -> 100000]. NaN
 * before the first period is over. Does not block. */
const double* wb_gyro_get_values(WbDeviceTag tag);

/** The response curve belongs to the world's proximity profile and not to the program: no rows. */
int wb_gyro_get_lookup_table_size(WbDeviceTag tag);
const double* wb_gyro_get_lookup_table(WbDeviceTag tag);

TP_C_END

#endif
