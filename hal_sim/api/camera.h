/* SPDX-License-Identifier: MIT
 * What the files of the camera share: how much of the zoom the sensor does itself, and the driver's mask.
 */
#ifndef TWINPUCK_API_CAMERA_H
#define TWINPUCK_API_CAMERA_H

#define CAMERA_ADDRESS 0xDC
#define LINE_CONF_SIZE \
  330 /* bytes of a line that the fast driver's mask can tell of, its end mark included */

/** Sub-sampling by the sensor: 4 when both zooms are multiples of 4, 2 when both are even, else 1. */
static inline int sensor_sampling(unsigned int zoom_width, unsigned int zoom_height) {
  if (zoom_width % 4 == 0 && zoom_height % 4 == 0) return 4;
  return zoom_width % 2 == 0 && zoom_height % 2 == 0 ? 2 : 1;
}

/** 1 for grey and for modes that nobody knows, 2 for RGB565 and YUV. */
static inline int camera_bytes_per_pixel(int color_mode) {
  return color_mode == 1 || color_mode == 2 ? 2 : 1;
}

#endif
