/* SPDX-License-Identifier: MIT
 * Position, a device of kind "gps" that the world file adds ([[robot.device]]). It tells the truth, without
 * noise. In the simulator only.
 */
#ifndef WB_GPS_H
#define WB_GPS_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_gps_enable(WbDeviceTag tag, int sampling_period);
void wb_gps_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_gps_get_sampling_period(WbDeviceTag tag);

/** Position of the robot's middle on the floor, m, x y z of the world in its convention (key axes of
 * [webots]), valid until the next step. NaN before the first period is over. Does not block. */
const double* wb_gps_get_values(WbDeviceTag tag);

/** m/s along the path, and as x y z. */
double wb_gps_get_speed(WbDeviceTag tag);
const double* wb_gps_get_speed_vector(WbDeviceTag tag);

typedef enum { WB_GPS_LOCAL_COORDINATE = 0, WB_GPS_WGS84_COORDINATE } WbGpsCoordinateSystem;

/** Programs of the PC: the world's own axes, always. */
WbGpsCoordinateSystem wb_gps_get_coordinate_system(WbDeviceTag tag);

/** Programs of the PC: an angle as text, such as 46 degrees 31' 2''; valid until the next call. */
const char* wb_gps_convert_to_degrees_minutes_seconds(double decimal_degrees);

TP_C_END

#endif
