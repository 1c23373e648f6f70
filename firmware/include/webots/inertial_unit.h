/* SPDX-License-Identifier: MIT
 * Attitude, a device of kind "inertial" that the world file adds ([[robot.device]]). In the simulator only.
 */
#ifndef WB_INERTIAL_UNIT_H
#define WB_INERTIAL_UNIT_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_inertial_unit_enable(WbDeviceTag tag, int sampling_period);
void wb_inertial_unit_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_inertial_unit_get_sampling_period(WbDeviceTag tag);

/** Roll, pitch and yaw in rad, valid until the next step. Yaw: the heading, -pi to pi; roll and pitch: 0 on
 * the flat floor. NaN before the first period is over. Does not block. */
const double* wb_inertial_unit_get_roll_pitch_yaw(WbDeviceTag tag);

/** Programs of the PC: the same as x, y, z, w, valid until the next call; and its noise, 0. */
const double* wb_inertial_unit_get_quaternion(WbDeviceTag tag);
double wb_inertial_unit_get_noise(WbDeviceTag tag);

TP_C_END

#endif
