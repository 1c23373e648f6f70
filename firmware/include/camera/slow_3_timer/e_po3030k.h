/* SPDX-License-Identifier: MIT
 * The PO3030K camera sensor, slow variant: timers 1, 4 and 5 count pixels, lines and frames, handlers in C,
 * 0.2 to 1.1 pictures a second. Rarely used. Cannot be used beside basic e_motors.h or basic e_prox.h.
 *
 * All setters edit a table in memory; nothing reaches the sensor before e_po3030k_write_cam_registers(),
 * e_po3030k_write_gamma_coef() or e_po3030k_sync_register_array().
 * Shares its guard with fast_2_timer/e_po3030k.h.
 */
#ifndef __PO3030K_H__
#define __PO3030K_H__

#include "../../twinpuck.h"

#define PO3030K_FULL 1 /* the settings below the line are compiled in */

/* the sensor, pixels */
#define ARRAY_WIDTH 640
#define ARRAY_HEIGHT 480

/* argument color_mode */
#define GREY_SCALE_MODE 0
#define RGB_565_MODE 1
#define YUV_MODE 2

/* sampling modes */
#define MODE_VGA 0x44
#define MODE_QVGA 0x11
#define MODE_QQVGA 0x33

/* pixel clock = main clock divided by */
#define SPEED_2 0x00
#define SPEED_2_3 0x10
#define SPEED_4 0x20
#define SPEED_8 0x30
#define SPEED_16 0x40
#define SPEED_32 0x50
#define SPEED_64 0x60
#define SPEED_128 0x70

/** Selects window, zoom and colours; arguments and result as e_poxxxx_config_cam(), but lines of any length. */
int e_po3030k_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                         unsigned int sensor_height, unsigned int zoom_fact_width,
                         unsigned int zoom_fact_height, int color_mode) TP_VARIANT(tpslow_, e_po3030k_config_cam);

/** 1 for grey, 2 for RGB565 and YUV, 1 for unknown modes. */
int e_po3030k_get_bytes_per_pixel(int color_mode);

/** Resets and configures the camera: blocks for tens of milliseconds. */
void e_po3030k_init_cam(void);

/** Sends the whole table: blocks for about 45 ms. */
void e_po3030k_write_cam_registers(void);

/** Starts a capture into `buf` with the next frame; returns at once. LED 0 toggles with every byte. */
void e_po3030k_launch_capture(char *buf) TP_VARIANT(tpslow_, e_po3030k_launch_capture);

/** Which bytes of a line are kept: part of e_po3030k_config_cam(). */
void e_po3030k_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl)
    TP_VARIANT(tpslow_, e_po3030k_apply_timer_config);

/** 1 when the picture is complete, until the next launch. */
int e_po3030k_is_img_ready(void) TP_VARIANT(tpslow_, e_po3030k_is_img_ready);

/** Colour mode, sampling mode, pixel clock (not SPEED_128). 0, or -1 for a wrong argument. */
int e_po3030k_set_color_mode(int mode);
int e_po3030k_set_sampling_mode(int mode);
int e_po3030k_set_speed(int mode);

/** Window of the sensor, columns up to 899 and lines up to 499. 0, or -1 for a wrong argument. */
int e_po3030k_set_wx(unsigned int start, unsigned int stop);
int e_po3030k_set_wy(unsigned int start, unsigned int stop);

/** Where the frame signal rises and falls. 0, or -1 for a wrong argument. */
int e_po3030k_set_vsync(unsigned int start, unsigned int stop, unsigned int col);

/** Fills the table from the sensor: blocks for about 50 ms. */
void e_po3030k_read_cam_registers(void);

#if PO3030K_FULL

/** Direct access to the table: value for register `adr`; -1 when the table does not hold it, else 0. */
int e_po3030k_set_register(unsigned char adr, unsigned char value);
int e_po3030k_get_register(unsigned char adr, unsigned char *value);

/** Pixel and operating-point bias. */
void e_po3030k_set_bias(unsigned char pixbias, unsigned char opbias);

/** Integration time, sensor units. */
void e_po3030k_set_integr_time(unsigned long time);

/** Mirrors the picture. */
void e_po3030k_set_mirror(int vertical, int horizontal);

/** Offset of the sensor's converter. */
void e_po3030k_set_adc_offset(unsigned char offset);

/** Sepia on or off. */
void e_po3030k_set_sepia(int status);

/** Lens shading gains. */
void e_po3030k_set_lens_gain(unsigned char red, unsigned char green, unsigned char blue);

/** Edge enhancement: gain and threshold. */
void e_po3030k_set_edge_prop(unsigned char gain, unsigned char tresh);

/** Gamma curve of one colour. Only the first two values are taken, as in the original. */
void e_po3030k_set_gamma_coef(unsigned char array[12], char color);

/** Sends the gamma curves. Blocks for the I2C transactions. */
void e_po3030k_write_gamma_coef(void);

/** Sends the registers from `start` to `stop`; returns how many. Blocks for about 0.4 ms each. */
int e_po3030k_sync_register_array(unsigned char start, unsigned char stop);

/** Colour matrix. Only the first two values are taken, as in the original. */
void e_po3030k_set_color_matrix(unsigned char array[3*3]);

/** Gains of the colour differences. */
void e_po3030k_set_cb_cr_gain(unsigned char cg11c, unsigned char cg22c);

/** Brightness and contrast. */
void e_po3030k_set_brigh_contr(unsigned char bright, unsigned char contrast);

/** Tone of the sepia. */
void e_po3030k_set_sepia_tone(unsigned char cb, unsigned char cr);

/** Weight of the centre window for automatic exposure. */
void e_po3030k_set_ww(unsigned char ww);

/** Tolerances and speeds of the automatics. */
void e_po3030k_set_awb_ae_tol(unsigned char awbm, unsigned char aem);
void e_po3030k_set_ae_speed(unsigned char b, unsigned char d);

/** Exposure: value, target of the automatic, limits. */
void e_po3030k_set_exposure(long t);
void e_po3030k_set_ref_exposure(unsigned char exp);
void e_po3030k_set_max_min_exp(unsigned int min, unsigned int max);

/** Limits of the automatic white balance. */
void e_po3030k_set_max_min_awb(unsigned char minb, unsigned char maxb, unsigned char minr, unsigned char maxr,
                               unsigned char ratior, unsigned char ratiob);

/** Window the automatic exposure looks at; -1 when outside the array, else 0. */
int e_po3030k_set_weight_win(unsigned int x1, unsigned int x2, unsigned int y1, unsigned int y2);

/** Automatic white balance, automatic exposure: 1 on, 0 off. */
void e_po3030k_set_awb_ae(int awb, int ae);

/** Gains, `global` at most 79; -1 above, else 0. */
int e_po3030k_set_color_gain(unsigned char global, unsigned char red, unsigned char green1,
                             unsigned char green2, unsigned char blue);

/** Flicker of lamps: manual or automatic, frequencies looked for, manual settings (fk and tol 0 to 3). */
void e_po3030k_set_flicker_mode(int manual);
void e_po3030k_set_flicker_detection(int hz50, int hz60);
int e_po3030k_set_flicker_man_set(int hz50, int hz60, int fdm, int fk, int tol);

#endif

#endif
