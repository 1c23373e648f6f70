/* SPDX-License-Identifier: MIT
 * Touch sensors. The e-puck has none: a device of the name does not exist unless a supervisor defines a
 * virtual sensor of it.
 */
#ifndef WB_TOUCH_SENSOR_H
#define WB_TOUCH_SENSOR_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first value is there one
 * period later. Does not block. */
void wb_touch_sensor_enable(WbDeviceTag tag, int sampling_period);
void wb_touch_sensor_disable(WbDeviceTag tag);

/** ms; 0 when disabled. */
int wb_touch_sensor_get_sampling_period(WbDeviceTag tag);

/** What the supervisor says, NaN without one. Does not block. */
double wb_touch_sensor_get_value(WbDeviceTag tag);

typedef enum { WB_TOUCH_SENSOR_BUMPER = 0, WB_TOUCH_SENSOR_FORCE, WB_TOUCH_SENSOR_FORCE3D } WbTouchSensorType;

/* programs of the PC */
const double* wb_touch_sensor_get_values(WbDeviceTag tag);
WbTouchSensorType wb_touch_sensor_get_type(WbDeviceTag tag);
int wb_touch_sensor_get_lookup_table_size(WbDeviceTag tag);
const double* wb_touch_sensor_get_lookup_table(WbDeviceTag tag);

TP_C_END

#endif
