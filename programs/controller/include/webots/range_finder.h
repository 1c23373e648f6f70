/* SPDX-License-Identifier: MIT
 * Range finders, of [[robot.device]]: a picture of distances in m along their line of sight. What is nearer
 * or farther than they see is infinite, and everything is before the first sample. Null: as for lidars.
 */
#ifndef WB_RANGE_FINDER_H
#define WB_RANGE_FINDER_H

#include <webots/types.h>

TP_C_BEGIN

void wb_range_finder_enable(WbDeviceTag tag, int sampling_period);
void wb_range_finder_disable(WbDeviceTag tag);
int wb_range_finder_get_sampling_period(WbDeviceTag tag);
const float* wb_range_finder_get_range_image(WbDeviceTag tag);
int wb_range_finder_get_width(WbDeviceTag tag);
int wb_range_finder_get_height(WbDeviceTag tag);
double wb_range_finder_get_fov(WbDeviceTag tag);
double wb_range_finder_get_min_range(WbDeviceTag tag);
double wb_range_finder_get_max_range(WbDeviceTag tag);
int wb_range_finder_save_image(WbDeviceTag tag, const char* filename, int quality);

/** m, of a pixel; x from the left, y from the top. */
#define wb_range_finder_image_get_depth(image, width, x, y) ((image)[(y) * (width) + (x)])

TP_C_END

#endif
