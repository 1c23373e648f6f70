/* SPDX-License-Identifier: MIT
 * Camera, device "camera": a picture of 52 x 39 pixels of the robot's camera at zoom 8, as Webots' e-puck
 * has.
 *
 * The picture is taken as RGB565 and told as BGRA, 8112 bytes, which the robot's memory does not hold: on the
 * robot the functions are missing, and the program does not link. The camera runs freely; a step finds the
 * newest whole picture.
 */
#ifndef WB_CAMERA_H
#define WB_CAMERA_H

#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first picture is there one
 *  period later, or when the camera has taken it. Starting the camera blocks for about 0.1 s. */
void wb_camera_enable(WbDeviceTag tag, int sampling_period);
void wb_camera_disable(WbDeviceTag tag);
int wb_camera_get_sampling_period(WbDeviceTag tag);

/** Rows from the top, 4 bytes a pixel: blue, green, red, 255. Black before the first,
 * null when the camera is not enabled. Does not block. */
const unsigned char* wb_camera_get_image(WbDeviceTag tag);

/** Pixels: 52 and 39. */
int wb_camera_get_width(WbDeviceTag tag);
int wb_camera_get_height(WbDeviceTag tag);

/** Horizontal, rad. It cannot be changed. */
double wb_camera_get_fov(WbDeviceTag tag);

/** Nearest distance that is seen, m: 0. */
double wb_camera_get_near(WbDeviceTag tag);

/** Colour of a pixel, 0 to 255; x from the left, y from the top. */
#define wb_camera_image_get_red(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + 2])
#define wb_camera_image_get_green(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + 1])
#define wb_camera_image_get_blue(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x))])
#define wb_camera_image_get_gray(image, width, x, y)                        \
  ((unsigned char)(((unsigned)wb_camera_image_get_red(image, width, x, y) + \
                    wb_camera_image_get_green(image, width, x, y) +         \
                    wb_camera_image_get_blue(image, width, x, y)) /         \
                   3))
#define wb_camera_image_get_grey(image, width, x, y) wb_camera_image_get_gray(image, width, x, y)

TP_C_END

#endif
