/* SPDX-License-Identifier: MIT
 * The PO6030K camera sensor (robots from number 1500, before revision 1.3). Pictures are taken with
 * e_poxxxx.h; this file has its settings. Every setter writes to the sensor at once: two I2C transactions,
 * about 1 ms.
 */
#ifndef __PO6030K_H__
#define __PO6030K_H__

#include "e_poxxxx.h"

/* sampling modes */
#define PO_6030_MODE_VGA 0x20
#define PO_6030_MODE_QVGA 0x40
#define PO_6030_MODE_QQVGA 0x80

/* divisors of the sensor's clock */
#define BAYER_CLOCK_1 0x10
#define BAYER_CLOCK_2 0x50
#define BAYER_CLOCK_4 0x90
#define BAYER_CLOCK_8 0xB0
#define PO_6030_SPEED_1 BAYER_CLOCK_1
#define PO_6030_SPEED_2 BAYER_CLOCK_2
#define PO_6030_SPEED_4 BAYER_CLOCK_4
#define PO_6030_SPEED_8 BAYER_CLOCK_8

/* register banks */
#define BANK_A 0x0
#define BANK_B 0x1
#define BANK_C 0x2
#define BANK_D 0x3

#define e_po6030k_set_speed(div) e_po6030k_set_bayer_clkdiv(div)

/* argument of e_po6030k_set_sketch_mode() */
#define E_PO6030K_SKETCH_BW 0
#define E_PO6030K_SKETCH_COLOR 1

/** Selects window, zoom and colours; arguments as e_poxxxx_config_cam(). Returns 0, or not 0 for a wrong
 *  request. */
int e_po6030k_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                     unsigned int sensor_height, unsigned int zoom_fact_width,
                     unsigned int zoom_fact_height, int color_mode);

/** 1 for grey, 2 for RGB565 and YUV, 1 for unknown modes. */
int e_po6030k_get_bytes_per_pixel(int color_mode);

/** Declared by the original, not defined in it. */
void e_po6030k_set_color_mode(unsigned char format);

/** Bank for the register accesses that follow; then any register. */
void e_po6030k_set_bank(unsigned char bank);
void e_po6030k_write_register(unsigned char bank, unsigned char reg, unsigned char value);

/** Divisors of sensor clock and pixel clock. */
void e_po6030k_set_bayer_clkdiv(unsigned char div);
void e_po6030k_set_pclkdiv(unsigned char div);

/** Colour format and sampling mode. 0, or -1 for a wrong argument. */
int e_po6030k_set_mode(unsigned char format, unsigned char sampl_mode);

/** Window: columns up to 799; lines are accepted and ignored, as in the original. 0, or -1 for a wrong
 *  argument. */
int e_po6030k_set_wx(unsigned int start, unsigned int stop);
int e_po6030k_set_wy(unsigned int start, unsigned int stop);

/** Where the frame signal rises and falls. 0, or -1 for a wrong argument. */
int e_po6030k_set_vsync(unsigned int start, unsigned int stop);

/** Drawing effect: E_PO6030K_SKETCH_BW or E_PO6030K_SKETCH_COLOR. */
void e_po6030k_set_sketch_mode(int mode);

/** Mirrors the picture. */
void e_po6030k_set_mirror(int vertical, int horizontal);

/** Automatic white balance, automatic exposure: 1 on, 0 off. */
void e_po6030k_set_awb_ae(int awb, int ae);

/** Gains, 0x40 = 1. */
void e_po6030k_set_rgb_gain(unsigned char r, unsigned char g, unsigned char b);

/** Exposure, sensor units, 32 bits. */
void e_po6030k_set_exposure(unsigned long exp);

#endif
