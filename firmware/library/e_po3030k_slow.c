/* SPDX-License-Identifier: MIT
 * Window, zoom and speed of the slow camera driver. The other settings are those of e_po3030k.c; the capture is each
 * HAL's own. Source: [lib: camera/slow_3_timer/e_calc.c], facts restated.
 */
#include "camera/slow_3_timer/e_po3030k.h"

#include "camera.h"

#define ORIGIN_X 210
#define ORIGIN_Y 7

int e_po3030k_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                         unsigned int sensor_height, unsigned int zoom_fact_width,
                         unsigned int zoom_fact_height, int color_mode) {
  int sampling, speed;
  sensor_x1 += ORIGIN_X;
  sensor_y1 += ORIGIN_Y;
  if (!camera_window_fits(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width, zoom_fact_height,
                          ORIGIN_X + ARRAY_WIDTH, ORIGIN_Y + ARRAY_HEIGHT))
    return -1;

  sampling = sensor_sampling(zoom_fact_width, zoom_fact_height);
  sensor_y1 -= (unsigned int)sampling;
  if (e_po3030k_set_color_mode(color_mode)) return -1;
  speed = sampling == 4 ? SPEED_32 : sampling == 2 ? SPEED_64 : SPEED_128;
  if (color_mode == GREY_SCALE_MODE) speed = sampling == 4 ? SPEED_16 : sampling == 2 ? SPEED_32 : SPEED_64;
  e_po3030k_set_speed(speed); /* refuses SPEED_128, so colour without sub-sampling keeps the speed it had */
  if (e_po3030k_set_sampling_mode(sampling == 4 ? MODE_QQVGA : sampling == 2 ? MODE_QVGA : MODE_VGA))
    return -1;
  if (e_po3030k_set_wx(sensor_x1, ORIGIN_X + ARRAY_WIDTH + 1)) return -1;
  if (e_po3030k_set_wy(sensor_y1, ORIGIN_Y + ARRAY_HEIGHT + 1)) return -1;
  if (e_po3030k_set_vsync(sensor_y1 - 1, ORIGIN_Y + ARRAY_HEIGHT, sensor_x1 + 1)) return -1;
  e_po3030k_apply_timer_config((int)(sensor_height / zoom_fact_height), (int)(sensor_width / zoom_fact_width),
                               e_po3030k_get_bytes_per_pixel(color_mode), (int)zoom_fact_width / sampling - 1,
                               (int)zoom_fact_height / sampling - 1);
  return 0;
}
