/* SPDX-License-Identifier: MIT
 * Position of the wheels: "left wheel sensor" and "right wheel sensor". The e-puck counts the steps that it
 * commands; a wheel that slips or is held is counted all the same.
 */
#ifndef WB_POSITION_SENSOR_H
#define WB_POSITION_SENSOR_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_position_sensor_enable(WbDeviceTag tag, int sampling_period);
void wb_position_sensor_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_position_sensor_get_sampling_period(WbDeviceTag tag);

/** rad, forward positive, 0 at the start, in steps of 2 pi / 1000. NaN before the first period is over. Does
 * not block. */
double wb_position_sensor_get_value(WbDeviceTag tag);

/** WB_ROTATIONAL. */
WbJointType wb_position_sensor_get_type(WbDeviceTag tag);

/** The motor of the same wheel; there is no brake: 0. */
WbDeviceTag wb_position_sensor_get_motor(WbDeviceTag tag);
WbDeviceTag wb_position_sensor_get_brake(WbDeviceTag tag);

TP_C_END

#endif
