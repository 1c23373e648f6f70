/* SPDX-License-Identifier: MIT
 * Camera, device "camera": a picture of 52 x 39 pixels of the robot's camera at zoom 8, as Webots' e-puck
 * has.
 *
 * The picture is taken as RGB565 and told as BGRA, 8112 bytes, which the robot's memory does not hold: on the
 * robot it stays RGB565, 4056 bytes, and is read by wb_camera_image_get_red() and its like alone. The camera runs
 * freely; a step finds the newest whole picture, on the robot one that is taken into the place of the last.
 */
#ifndef WB_CAMERA_H
#define WB_CAMERA_H

#include "camera_recognition_object.h"
#include "types.h"

TP_C_BEGIN

/** Period in ms, 1 to 32767, counted in whole robot steps; 0 or less disables. The first picture is there one
 *  period later, or when the camera has taken it. Starting the camera blocks for about 0.1 s. */
void wb_camera_enable(WbDeviceTag tag, int sampling_period);
void wb_camera_disable(WbDeviceTag tag);
int wb_camera_get_sampling_period(WbDeviceTag tag);

/** Rows from the top, 4 bytes a pixel: blue, green, red, 255; on the robot 2. Black before the first,
 * null when the camera is not enabled. Does not block. */
const unsigned char* wb_camera_get_image(WbDeviceTag tag);

/** Pixels: 52 and 39. */
int wb_camera_get_width(WbDeviceTag tag);
int wb_camera_get_height(WbDeviceTag tag);

/** Horizontal, rad. It cannot be changed. */
double wb_camera_get_fov(WbDeviceTag tag);
double wb_camera_get_min_fov(WbDeviceTag tag);
double wb_camera_get_max_fov(WbDeviceTag tag);

/** Versions 5 to 7: there is no window, nothing happens; always WB_CAMERA_COLOR. */
#define WB_CAMERA_COLOR 'c'
#define WB_CAMERA_RANGE_FINDER 'r'
#define WB_CAMERA_BOTH 'b'
void wb_camera_move_window(WbDeviceTag tag, int x, int y);
int wb_camera_get_type(WbDeviceTag tag);

/* --- programs of the PC: lens and exposure cannot be set, which a warning says; their values are 1 (exposure) and 0 */
void wb_camera_set_fov(WbDeviceTag tag, double fov);
double wb_camera_get_exposure(WbDeviceTag tag);
void wb_camera_set_exposure(WbDeviceTag tag, double exposure);
double wb_camera_get_focal_length(WbDeviceTag tag);
double wb_camera_get_focal_distance(WbDeviceTag tag);
double wb_camera_get_min_focal_distance(WbDeviceTag tag);
double wb_camera_get_max_focal_distance(WbDeviceTag tag);
void wb_camera_set_focal_distance(WbDeviceTag tag, double focal_distance);

/** Writes the newest picture, PNG or (`quality` 1 to 100) JPEG by the name's ending; relative names begin in the
 *  program's folder. 0; -1: it could not be written. */
int wb_camera_save_image(WbDeviceTag tag, const char* filename, int quality);

/* --- programs of the PC: objects with recognitionColors on the picture, of cameras that have a Recognition in the
 * world. Period in ms. The array is valid until the next step */
bool wb_camera_has_recognition(WbDeviceTag tag);
void wb_camera_recognition_enable(WbDeviceTag tag, int sampling_period);
void wb_camera_recognition_disable(WbDeviceTag tag);
int wb_camera_recognition_get_sampling_period(WbDeviceTag tag);
int wb_camera_recognition_get_number_of_objects(WbDeviceTag tag);
const WbCameraRecognitionObject* wb_camera_recognition_get_objects(WbDeviceTag tag);
const WbCameraRecognitionObject* wb_camera_recognition_get_object(WbDeviceTag tag, int index);
/** There is no segmentation: false, null, and -1. */
bool wb_camera_recognition_has_segmentation(WbDeviceTag tag);
void wb_camera_recognition_enable_segmentation(WbDeviceTag tag);
void wb_camera_recognition_disable_segmentation(WbDeviceTag tag);
bool wb_camera_recognition_is_segmentation_enabled(WbDeviceTag tag);
const unsigned char* wb_camera_recognition_get_segmentation_image(WbDeviceTag tag);
int wb_camera_recognition_save_segmentation_image(WbDeviceTag tag, const char* filename, int quality);

/** Nearest distance that is seen, m: 0. */
double wb_camera_get_near(WbDeviceTag tag);

/** Colour of a pixel, 0 to 255; x from the left, y from the top. */
#ifdef TP_ON_CHIP
/* RGB565, two bytes a pixel, the one with red first; what five or six bits hold is told as eight */
#define TP_RGB565_BYTE(image, width, x, y, which) \
  ((unsigned)((const unsigned char*)(image))[2 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + (which)])
#define wb_camera_image_get_red(image, width, x, y)                        \
  ((unsigned char)((TP_RGB565_BYTE(image, width, x, y, 0) & 0xF8u) | \
                   TP_RGB565_BYTE(image, width, x, y, 0) >> 5))
#define wb_camera_image_get_green(image, width, x, y)                           \
  ((unsigned char)((TP_RGB565_BYTE(image, width, x, y, 0) & 7u) << 5 |    \
                   (TP_RGB565_BYTE(image, width, x, y, 1) >> 3 & 0x1Cu) | \
                   (TP_RGB565_BYTE(image, width, x, y, 0) >> 1 & 3u)))
#define wb_camera_image_get_blue(image, width, x, y)                            \
  ((unsigned char)((TP_RGB565_BYTE(image, width, x, y, 1) & 0x1Fu) << 3 | \
                   (TP_RGB565_BYTE(image, width, x, y, 1) >> 2 & 7u)))
#else
#define wb_camera_image_get_red(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + 2])
#define wb_camera_image_get_green(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x)) + 1])
#define wb_camera_image_get_blue(image, width, x, y) \
  ((image)[4 * ((unsigned)(y) * (unsigned)(width) + (unsigned)(x))])
#endif
#define wb_camera_image_get_gray(image, width, x, y)                        \
  ((unsigned char)(((unsigned)wb_camera_image_get_red(image, width, x, y) + \
                    wb_camera_image_get_green(image, width, x, y) +         \
                    wb_camera_image_get_blue(image, width, x, y)) /         \
                   3))
#define wb_camera_image_get_grey(image, width, x, y) wb_camera_image_get_gray(image, width, x, y)

TP_C_END

#endif
