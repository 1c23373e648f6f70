/* SPDX-License-Identifier: MIT
 * Lidars, of [[robot.device]]: a row of distances in m from the left to the right. What is nearer or farther
 * than they see is infinite, and everything is before the first sample. Null: no such device, or it is not
 * enabled.
 */
#ifndef WB_LIDAR_H
#define WB_LIDAR_H

#include <webots/lidar_point.h>
#include <webots/types.h>

TP_C_BEGIN

void wb_lidar_enable(WbDeviceTag tag, int sampling_period);
void wb_lidar_disable(WbDeviceTag tag);
int wb_lidar_get_sampling_period(WbDeviceTag tag);
void wb_lidar_enable_point_cloud(WbDeviceTag tag);
void wb_lidar_disable_point_cloud(WbDeviceTag tag);
bool wb_lidar_is_point_cloud_enabled(WbDeviceTag tag);
const float* wb_lidar_get_range_image(WbDeviceTag tag);
const float* wb_lidar_get_layer_range_image(WbDeviceTag tag, int layer);
const WbLidarPoint* wb_lidar_get_point_cloud(WbDeviceTag tag);
const WbLidarPoint* wb_lidar_get_layer_point_cloud(WbDeviceTag tag, int layer);
int wb_lidar_get_number_of_points(WbDeviceTag tag);
int wb_lidar_get_horizontal_resolution(WbDeviceTag tag);
int wb_lidar_get_number_of_layers(WbDeviceTag tag);
double wb_lidar_get_min_frequency(WbDeviceTag tag);
double wb_lidar_get_max_frequency(WbDeviceTag tag);
double wb_lidar_get_frequency(WbDeviceTag tag);
void wb_lidar_set_frequency(WbDeviceTag tag, double frequency);
double wb_lidar_get_fov(WbDeviceTag tag);
double wb_lidar_get_vertical_fov(WbDeviceTag tag);
double wb_lidar_get_min_range(WbDeviceTag tag);
double wb_lidar_get_max_range(WbDeviceTag tag);

TP_C_END

#endif
