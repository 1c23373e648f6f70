/* SPDX-License-Identifier: MIT
 * Position, a device that the world file adds.
 * Interface of 2005 to 2008; webots/gps.h has the present one and says more.
 */
#ifndef DEVICE_GPS_H
#define DEVICE_GPS_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void gps_enable(DeviceTag tag, int ms);
void gps_disable(DeviceTag tag);

/** x, y, z in m, as in webots/gps.h. Valid until the next step; zeros before the first period is over. Does
 * not block. */
const float* gps_get_values(DeviceTag tag);

/** Position and attitude as a matrix of 16 numbers, column after column: right, up, backward, position. Valid
 * until the next step; zeros before the first period is over. Does not block. */
const float* gps_get_matrix(DeviceTag tag);

/** Parts of such a matrix: x, y, z in m. */
#define gps_position_x(matrix) ((matrix)[12])
#define gps_position_y(matrix) ((matrix)[13])
#define gps_position_z(matrix) ((matrix)[14])

/** Angles of such a matrix about x, y and z, rad; of a robot on a flat floor `angles`[1] is its rotation and
 * the others 0. */
void gps_euler(const float* matrix, float* angles);

TP_C_END

#endif
