/* SPDX-License-Identifier: MIT
 * Camera: the common driver and the settings of the three sensors. Bytes per pixel need no camera and are
 * real.
 */
#include "camera/fast_2_timer/e_po3030k.h"
#include "camera/fast_2_timer/e_po6030k.h"
#include "camera/fast_2_timer/e_po8030d.h"
#include "camera/fast_2_timer/e_poxxxx.h"
#include "unsimulated.h"
#define DEVICE "camera"

UNSIMULATED(int, e_poxxxx_config_cam, (unsigned int sensor_x1, unsigned int sensor_y1,
                                       unsigned int sensor_width, unsigned int sensor_height,
                                       unsigned int zoom_fact_width, unsigned int zoom_fact_height,
                                       int color_mode))
UNSIMULATED(int, e_poxxxx_init_cam, (void))
UNSIMULATED(int, e_poxxxx_get_orientation, (void))
UNSIMULATED_VOID(e_poxxxx_write_cam_registers, (void))
UNSIMULATED_VOID(e_poxxxx_launch_capture, (char *buf))
UNSIMULATED(int, e_poxxxx_is_img_ready, (void))
UNSIMULATED_VOID(e_poxxxx_set_mirror, (int vertical, int horizontal))
UNSIMULATED(int, e_poxxxx_apply_timer_config, (int pixel_row, int pixel_col, int bpp, int pbp, int bbl))
UNSIMULATED_VOID(e_poxxxx_set_awb_ae, (int awb, int ae))
UNSIMULATED_VOID(e_poxxxx_set_rgb_gain, (unsigned char r, unsigned char g, unsigned char b))
UNSIMULATED_VOID(e_poxxxx_set_exposure, (unsigned long exp))

/* in the library's object, in none of its headers */
unsigned int getCameraVersion();
UNSIMULATED(unsigned int, getCameraVersion, ())

UNSIMULATED(int, e_po3030k_config_cam, (unsigned int sensor_x1, unsigned int sensor_y1,
                                        unsigned int sensor_width, unsigned int sensor_height,
                                        unsigned int zoom_fact_width, unsigned int zoom_fact_height,
                                        int color_mode))
UNSIMULATED_VOID(e_po3030k_init_cam, (void))
UNSIMULATED_VOID(e_po3030k_write_cam_registers, (void))
UNSIMULATED(int, e_po3030k_set_color_mode, (int mode))
UNSIMULATED(int, e_po3030k_set_sampling_mode, (int mode))
UNSIMULATED(int, e_po3030k_set_speed, (int mode))
UNSIMULATED(int, e_po3030k_set_wx, (unsigned int start, unsigned int stop))
UNSIMULATED(int, e_po3030k_set_wy, (unsigned int start, unsigned int stop))
UNSIMULATED(int, e_po3030k_set_vsync, (unsigned int start, unsigned int stop, unsigned int col))
UNSIMULATED_VOID(e_po3030k_set_mirror, (int vertical, int horizontal))
UNSIMULATED_VOID(e_po3030k_read_cam_registers, (void))
UNSIMULATED(int, e_po3030k_set_register, (unsigned char adr, unsigned char value))
UNSIMULATED(int, e_po3030k_get_register, (unsigned char adr, unsigned char *value))
UNSIMULATED_VOID(e_po3030k_set_bias, (unsigned char pixbias, unsigned char opbias))
UNSIMULATED_VOID(e_po3030k_set_integr_time, (unsigned long time))
UNSIMULATED_VOID(e_po3030k_set_adc_offset, (unsigned char offset))
UNSIMULATED_VOID(e_po3030k_set_sepia, (int status))
UNSIMULATED_VOID(e_po3030k_set_lens_gain, (unsigned char red, unsigned char green, unsigned char blue))
UNSIMULATED_VOID(e_po3030k_set_edge_prop, (unsigned char gain, unsigned char tresh))
UNSIMULATED_VOID(e_po3030k_set_gamma_coef, (unsigned char array[12], char color))
UNSIMULATED_VOID(e_po3030k_write_gamma_coef, (void))
UNSIMULATED(int, e_po3030k_sync_register_array, (unsigned char start, unsigned char stop))
UNSIMULATED_VOID(e_po3030k_set_color_matrix, (unsigned char array[3*3]))
UNSIMULATED_VOID(e_po3030k_set_cb_cr_gain, (unsigned char cg11c, unsigned char cg22c))
UNSIMULATED_VOID(e_po3030k_set_brigh_contr, (unsigned char bright, unsigned char contrast))
UNSIMULATED_VOID(e_po3030k_set_sepia_tone, (unsigned char cb, unsigned char cr))
UNSIMULATED_VOID(e_po3030k_set_ww, (unsigned char ww))
UNSIMULATED_VOID(e_po3030k_set_awb_ae_tol, (unsigned char awbm, unsigned char aem))
UNSIMULATED_VOID(e_po3030k_set_ae_speed, (unsigned char b, unsigned char d))
UNSIMULATED_VOID(e_po3030k_set_exposure, (long t))
UNSIMULATED_VOID(e_po3030k_set_ref_exposure, (unsigned char exp))
UNSIMULATED_VOID(e_po3030k_set_max_min_exp, (unsigned int min, unsigned int max))
UNSIMULATED_VOID(e_po3030k_set_max_min_awb, (unsigned char minb, unsigned char maxb, unsigned char minr,
                                             unsigned char maxr, unsigned char ratior, unsigned char ratiob))
UNSIMULATED(int, e_po3030k_set_weight_win, (unsigned int x1, unsigned int x2, unsigned int y1,
                                            unsigned int y2))
UNSIMULATED_VOID(e_po3030k_set_awb_ae, (int awb, int ae))
UNSIMULATED(int, e_po3030k_set_color_gain, (unsigned char global, unsigned char red, unsigned char green1,
                                            unsigned char green2, unsigned char blue))
UNSIMULATED_VOID(e_po3030k_set_flicker_mode, (int manual))
UNSIMULATED_VOID(e_po3030k_set_flicker_detection, (int hz50, int hz60))
UNSIMULATED(int, e_po3030k_set_flicker_man_set, (int hz50, int hz60, int fdm, int fk, int tol))

UNSIMULATED(int, e_po6030k_config_cam, (unsigned int sensor_x1, unsigned int sensor_y1,
                                        unsigned int sensor_width, unsigned int sensor_height,
                                        unsigned int zoom_fact_width, unsigned int zoom_fact_height,
                                        int color_mode))
UNSIMULATED_VOID(e_po6030k_set_color_mode, (unsigned char format))
UNSIMULATED_VOID(e_po6030k_set_bank, (unsigned char bank))
UNSIMULATED_VOID(e_po6030k_write_register, (unsigned char bank, unsigned char reg, unsigned char value))
UNSIMULATED_VOID(e_po6030k_set_bayer_clkdiv, (unsigned char div))
UNSIMULATED_VOID(e_po6030k_set_pclkdiv, (unsigned char div))
UNSIMULATED(int, e_po6030k_set_mode, (unsigned char format, unsigned char sampl_mode))
UNSIMULATED(int, e_po6030k_set_wx, (unsigned int start, unsigned int stop))
UNSIMULATED(int, e_po6030k_set_wy, (unsigned int start, unsigned int stop))
UNSIMULATED(int, e_po6030k_set_vsync, (unsigned int start, unsigned int stop))
UNSIMULATED_VOID(e_po6030k_set_sketch_mode, (int mode))
UNSIMULATED_VOID(e_po6030k_set_mirror, (int vertical, int horizontal))
UNSIMULATED_VOID(e_po6030k_set_awb_ae, (int awb, int ae))
UNSIMULATED_VOID(e_po6030k_set_rgb_gain, (unsigned char r, unsigned char g, unsigned char b))
UNSIMULATED_VOID(e_po6030k_set_exposure, (unsigned long exp))

UNSIMULATED(int, e_po8030d_config_cam, (unsigned int sensor_x1, unsigned int sensor_y1,
                                        unsigned int sensor_width, unsigned int sensor_height,
                                        unsigned int zoom_fact_width, unsigned int zoom_fact_height,
                                        int color_mode))
UNSIMULATED_VOID(e_po8030d_set_color_mode, (unsigned char format))
UNSIMULATED_VOID(e_po8030d_set_bank, (unsigned char bank))
UNSIMULATED_VOID(e_po8030d_write_register, (unsigned char bank, unsigned char reg, unsigned char value))
UNSIMULATED_VOID(e_po8030d_set_bayer_clkdiv, (unsigned char div))
UNSIMULATED_VOID(e_po8030d_set_pclkdiv, (unsigned char div))
UNSIMULATED(int, e_po8030d_set_mode, (unsigned char format, unsigned char sampl_mode))
UNSIMULATED(int, e_po8030d_set_wx, (unsigned int start, unsigned int stop))
UNSIMULATED(int, e_po8030d_set_wy, (unsigned int start, unsigned int stop))
UNSIMULATED(int, e_po8030d_set_vsync, (unsigned int start, unsigned int stop))
UNSIMULATED_VOID(e_po8030d_set_sketch_mode, (int mode))
UNSIMULATED_VOID(e_po8030d_set_mirror, (int vertical, int horizontal))
UNSIMULATED_VOID(e_po8030d_set_awb_ae, (int awb, int ae))
UNSIMULATED_VOID(e_po8030d_set_rgb_gain, (unsigned char r, unsigned char g, unsigned char b))
UNSIMULATED_VOID(e_po8030d_set_exposure, (unsigned long exp))
UNSIMULATED(int, testWriteReg, (unsigned char bank))
UNSIMULATED(int, init_po8030, ())
UNSIMULATED_VOID(e_po8030d_set_brightness, (signed char value))

static int bytes_per_pixel(int color_mode) {
  return color_mode == RGB_565_MODE || color_mode == YUV_MODE ? 2 : 1; /* unknown modes: 1, as the original */
}

int e_po3030k_get_bytes_per_pixel(int color_mode) { return bytes_per_pixel(color_mode); }

int e_po6030k_get_bytes_per_pixel(int color_mode) { return bytes_per_pixel(color_mode); }

int e_po8030d_get_bytes_per_pixel(int color_mode) { return bytes_per_pixel(color_mode); }
