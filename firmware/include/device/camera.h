/* SPDX-License-Identifier: MIT
 * Camera, device "camera": 52 x 39 pixels.
 * Interface of 2005 to 2008; webots/camera.h has the present one and says more.
 */
#ifndef DEVICE_CAMERA_H
#define DEVICE_CAMERA_H

#include "robot_types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. Starting the camera blocks for
 * about 0.1 s. */
void camera_enable(DeviceTag tag, int ms);
void camera_disable(DeviceTag tag);

/** Rows from the top, 4 bytes a pixel: blue, green, red, 255; on the robot 2. Black before the first,
 * null when the camera is not enabled. Does not block. */
unsigned char* camera_get_image(DeviceTag tag);

/** Pixels: 52 and 39. */
int camera_get_width(DeviceTag tag);
int camera_get_height(DeviceTag tag);

/** Horizontal field of view, rad. */
float camera_get_fov(DeviceTag tag);

/** The picture cannot be shown in a window: nothing happens. */
void camera_move_window(DeviceTag tag, int x, int y);

/** Colour of a pixel, 0 to 255; x from the left, y from the top. */
#ifdef TP_ON_CHIP
/* RGB565, two bytes a pixel, the one with red first; what five or six bits hold is told as eight */
#define TP_RGB565_BYTE(image, width, x, y, which) \
  ((unsigned)((const unsigned char*)(image))[2 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + (which)])
#define camera_image_get_red(image, width, x, y)                        \
  ((unsigned char)((TP_RGB565_BYTE(image, width, x, y, 0) & 0xF8u) | \
                   TP_RGB565_BYTE(image, width, x, y, 0) >> 5))
#define camera_image_get_green(image, width, x, y)                           \
  ((unsigned char)((TP_RGB565_BYTE(image, width, x, y, 0) & 7u) << 5 |    \
                   (TP_RGB565_BYTE(image, width, x, y, 1) >> 3 & 0x1Cu) | \
                   (TP_RGB565_BYTE(image, width, x, y, 0) >> 1 & 3u)))
#define camera_image_get_blue(image, width, x, y)                            \
  ((unsigned char)((TP_RGB565_BYTE(image, width, x, y, 1) & 0x1Fu) << 3 | \
                   (TP_RGB565_BYTE(image, width, x, y, 1) >> 2 & 7u)))
#else
#define camera_image_get_red(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + 2])
#define camera_image_get_green(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + 1])
#define camera_image_get_blue(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x))])
#endif
#define camera_image_get_grey(image, width, x, y)                        \
  ((unsigned char)(((unsigned)camera_image_get_red(image, width, x, y) + \
                    camera_image_get_green(image, width, x, y) +         \
                    camera_image_get_blue(image, width, x, y)) /         \
                   3))

TP_C_END

#endif
