/* SPDX-License-Identifier: MIT
 * The camera, whichever of three sensors the robot carries (PO3030K, PO6030K, PO8030D). The usual variant.
 *
 * Timers 4 and 5 count lines and frames, interrupts of priority 6; so basic e_motors.h cannot be used beside
 * it. A picture is row after row. Grey: 1 byte a pixel. RGB565: 2 bytes, first RRRRRGGG, then GGGBBBBB. YUV:
 * 2 bytes. The robot's memory is 8 KB: 40 x 40 in colour, 3200 bytes, is a usual size.
 */
#ifndef __POXXXX_H__
#define __POXXXX_H__

#include "../../twinpuck.h"

#define POXXXX_FULL 1

/* the sensor, pixels */
#define ARRAY_WIDTH 640
#define ARRAY_HEIGHT 480

/* argument color_mode */
#define GREY_SCALE_MODE 0
#define RGB_565_MODE 1
#define YUV_MODE 2

/** Selects window, zoom and colours. Window in sensor pixels before zooming: sensor_width = image width x
 *  zoom. x1 + width <= 640, y1 + height <= 480, zooms >= 1 and divisors of the sizes, and a line must fit the
 *  driver's table (about 82 colour or 164 grey pixels at zoom 8). Returns 0, or not 0 for a wrong request.
 *  PO3030K: takes effect with e_poxxxx_write_cam_registers(). */
int e_poxxxx_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                        unsigned int sensor_height, unsigned int zoom_fact_width,
                        unsigned int zoom_fact_height, int color_mode);

/** Resets and identifies the camera: returns 0x3030, 0x6030 or 0x8030. Calls e_init_port(), so LEDs go out
 *  and motors lose their current. Blocks for tens of milliseconds. */
int e_poxxxx_init_cam(void);

/** How the sensor is mounted: 0 to 2, quarter turns; -1 unknown camera. */
int e_poxxxx_get_orientation(void);

/** Sends the settings to the PO3030K: blocks for about 45 ms. Nothing for the other two. */
void e_poxxxx_write_cam_registers(void);

/** Starts a capture into `buf` with the next frame; returns at once. A running capture is restarted. */
void e_poxxxx_launch_capture(char *buf);

/** 1 when the last line has been stored, until the next launch; 0 before any launch. A capture takes up to
 *  two frame times. */
int e_poxxxx_is_img_ready(void);

/** Mirrors the picture. PO3030K: needs e_poxxxx_write_cam_registers(). */
void e_poxxxx_set_mirror(int vertical, int horizontal);

/** Which bytes of a line are kept: part of e_poxxxx_config_cam(). Returns 0, or -1 when the line does not
 *  fit. */
int e_poxxxx_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl);

/** Automatic white balance, automatic exposure: 1 on, 0 off. PO3030K: needs
 *  e_poxxxx_write_cam_registers(). */
void e_poxxxx_set_awb_ae(int awb, int ae);

/** Gains, 0x40 = 1. */
void e_poxxxx_set_rgb_gain(unsigned char r, unsigned char g, unsigned char b);

/** Exposure in the sensor's units. */
void e_poxxxx_set_exposure(unsigned long exp);

#endif
