/* SPDX-License-Identifier: MIT
 * Radars. No e-puck has one here: no device of the kind exists, so each function warns of its tag, and
 * answers 0.
 */
#ifndef WB_RADAR_H
#define WB_RADAR_H

#include <webots/radar_target.h>
#include <webots/types.h>

TP_C_BEGIN

void wb_radar_enable(WbDeviceTag tag, int sampling_period);
void wb_radar_disable(WbDeviceTag tag);
int wb_radar_get_sampling_period(WbDeviceTag tag);
int wb_radar_get_number_of_targets(WbDeviceTag tag);
const WbRadarTarget* wb_radar_get_targets(WbDeviceTag tag);
double wb_radar_get_min_range(WbDeviceTag tag);
double wb_radar_get_max_range(WbDeviceTag tag);
double wb_radar_get_horizontal_fov(WbDeviceTag tag);
double wb_radar_get_vertical_fov(WbDeviceTag tag);

TP_C_END

#endif
