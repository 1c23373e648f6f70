/* SPDX-License-Identifier: MIT
 * Height above the world's floor, m.
 */
#ifndef WB_ALTIMETER_H
#define WB_ALTIMETER_H

#include <webots/types.h>

TP_C_BEGIN

/** Period in ms; 0 or less disables. */
void wb_altimeter_enable(WbDeviceTag tag, int sampling_period);
void wb_altimeter_disable(WbDeviceTag tag);
int wb_altimeter_get_sampling_period(WbDeviceTag tag);
/** NaN before the first period is over. */
double wb_altimeter_get_value(WbDeviceTag tag);

TP_C_END

#endif
