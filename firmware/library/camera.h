/* SPDX-License-Identifier: MIT
 * What the files of the camera share: how much of the zoom the sensor does itself, which windows fit, the
 * driver's mask, and the registers of the two sensors that keep them in banks.
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

/** Whether a window whose first pixel is (x, y) of the sensor ends before `right` and `bottom`, and its size
 * is a multiple of the zoom. */
static inline int camera_window_fits(unsigned int x, unsigned int y, unsigned int width, unsigned int height,
                                     unsigned int zoom_width, unsigned int zoom_height, unsigned int right,
                                     unsigned int bottom) {
  return zoom_height >= 1 && zoom_width >= 1 && x + width <= right && y + height <= bottom &&
         width % zoom_width == 0 && height % zoom_height == 0;
}

/* the mask's marks, a byte each: e_line_interrupt.s knows them too */
#define SKIP 0
#define TAKE 1
#define END_OF_LINE 2

/** Fills the mask (LINE_CONF_SIZE bytes) for `pixels` of `bytes` each, with `skipped` pixels left out after each.
 * -1: too long for it, nothing changed. */
static inline int camera_fill_line_conf(char *mask, int pixels, int bytes, int skipped) {
  int i, j;
  if ((unsigned int)(pixels * bytes * (1 + skipped) + 1) > LINE_CONF_SIZE) return -1;
  for (i = 0; i < pixels; i++)
    for (j = 0; j < bytes * (1 + skipped); j++) *mask++ = j < bytes ? TAKE : SKIP;
  *mask = END_OF_LINE;
  return 0;
}

#define CAMERA_BANK_REGISTER 3
/** PO6030K and PO8030D: chooses a bank; with it, writes or reads one register there. Each is a bus transfer
 * or two. */
void hal_camera_set_bank(unsigned char bank);
void hal_camera_write(unsigned char bank, unsigned char reg, unsigned char value);
unsigned char hal_camera_read(unsigned char bank, unsigned char reg);

#endif
