/* SPDX-License-Identifier: MIT
 * Light sensors ls0 to ls7: the proximity ring without its flash, numbered as that.
 */
#ifndef WB_LIGHT_SENSOR_H
#define WB_LIGHT_SENSOR_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_light_sensor_enable(WbDeviceTag tag, int sampling_period);
void wb_light_sensor_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_light_sensor_get_sampling_period(WbDeviceTag tag);

/** Counts of e_get_ambient_light(), 0 to 4095: nearly 4095 in the dark, less with light. NaN before the first
 *  period is over. Does not block. */
double wb_light_sensor_get_value(WbDeviceTag tag);

/** The response curve belongs to the world's proximity profile and not to the program: no rows. */
int wb_light_sensor_get_lookup_table_size(WbDeviceTag tag);
const double* wb_light_sensor_get_lookup_table(WbDeviceTag tag);

TP_C_END

#endif
