/* SPDX-License-Identifier: MIT
 * Compass, a device of kind "compass" that the world file adds ([[robot.device]]). It tells the truth,
 * without noise. In the simulator only; the module that the robot can carry is a part (docs/extending.md).
 */
#ifndef WB_COMPASS_H
#define WB_COMPASS_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_compass_enable(WbDeviceTag tag, int sampling_period);
void wb_compass_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_compass_get_sampling_period(WbDeviceTag tag);

/** Unit vector to the north in the robot's axes, valid until the next step. North: enu, the world's y axis,
 *  measured in the robot's forward, left, up; nue, the world's x axis in right, up, backward, as Webots of
 *  those versions has it. NaN before the first period is over. Does not block. */
const double* wb_compass_get_values(WbDeviceTag tag);

/** The response curve belongs to the world's proximity profile and not to the program: no rows. */
int wb_compass_get_lookup_table_size(WbDeviceTag tag);
const double* wb_compass_get_lookup_table(WbDeviceTag tag);

TP_C_END

#endif
