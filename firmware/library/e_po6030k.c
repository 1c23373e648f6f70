/* SPDX-License-Identifier: MIT
 * The PO6030K: every setter chooses a bank (register 3) and writes to the sensor at once.
 *
 * Quirk kept: the window's lines are accepted and ignored; the picture's first line is where VSYNC rises.
 * Source: [lib: camera/fast_2_timer/e_po6030k_registers.c, e_calc_po6030k.c], facts restated.
 */
#include "camera/fast_2_timer/e_po6030k.h"

#include "camera.h"

#define ORIGIN_X 80
#define ORIGIN_Y 8
#define BLANK_X 64 /* of the origin, before which no window begins */
#define IRQ_PIXELS 1

/* in the library's object, not in its header */
unsigned char e_po6030k_read_register(unsigned char bank, unsigned char reg);

void e_po6030k_set_bank(unsigned char bank) { hal_camera_set_bank(bank); }

void e_po6030k_write_register(unsigned char bank, unsigned char reg, unsigned char value) {
  hal_camera_write(bank, reg, value);
}

unsigned char e_po6030k_read_register(unsigned char bank, unsigned char reg) {
  return hal_camera_read(bank, reg);
}

int e_po6030k_get_bytes_per_pixel(int color_mode) { return camera_bytes_per_pixel(color_mode); }

void e_po6030k_set_bayer_clkdiv(unsigned char div) { e_po6030k_write_register(BANK_A, 0x91, div); }

void e_po6030k_set_pclkdiv(unsigned char div) { e_po6030k_write_register(BANK_B, 0x68, div); }

int e_po6030k_set_mode(unsigned char format, unsigned char sampl_mode) {
  unsigned char divisor;
  switch (format) {
    case GREY_SCALE_MODE:
      e_po6030k_write_register(BANK_B, 0x38, 0x0D);
      break;
    case RGB_565_MODE:
      e_po6030k_write_register(BANK_B, 0x38, 0x08);
      break;
    case YUV_MODE:
      e_po6030k_write_register(BANK_B, 0x38, 0x02);
      break;
    default:
      return -1;
  }
  divisor = sampl_mode == PO_6030_MODE_VGA ? 1 : sampl_mode == PO_6030_MODE_QVGA ? 2 : 4;
  if (divisor == 4 && sampl_mode != PO_6030_MODE_QQVGA) return -1;
  if (format == GREY_SCALE_MODE) divisor *= 2;
  e_po6030k_set_pclkdiv((unsigned char)(divisor - 1));
  e_po6030k_write_register(BANK_B, 0x80, sampl_mode);
  e_po6030k_write_register(BANK_B, 0x81, sampl_mode);
  e_po6030k_write_register(BANK_B, 0x82, 1);
  return 0;
}

int e_po6030k_set_wx(unsigned int start, unsigned int stop) {
  if (start >= stop || stop > 799) return -1;
  start--;
  e_po6030k_write_register(BANK_B, 0x51, (unsigned char)start);
  e_po6030k_write_register(BANK_B, 0x50, (unsigned char)(start >> 8));
  return 0;
}

int e_po6030k_set_wy(unsigned int start, unsigned int stop) {
  (void)start;
  (void)stop;
  return 0;
}

int e_po6030k_set_vsync(unsigned int start, unsigned int stop) {
  if (start >= stop || stop > 499) return -1;
  e_po6030k_write_register(BANK_B, 0x60, (unsigned char)(start >> 8));
  e_po6030k_write_register(BANK_B, 0x61, (unsigned char)start);
  e_po6030k_write_register(BANK_B, 0x62, (unsigned char)(stop >> 8));
  e_po6030k_write_register(BANK_B, 0x63, (unsigned char)stop);
  return 0;
}

int e_po6030k_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                         unsigned int sensor_height, unsigned int zoom_fact_width,
                         unsigned int zoom_fact_height, int color_mode) {
  unsigned int sampling;
  unsigned char mode, speed;
  sensor_x1 += ORIGIN_X - BLANK_X;
  sensor_y1 += ORIGIN_Y;
  if (!camera_window_fits(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width, zoom_fact_height,
                          ORIGIN_X + ARRAY_WIDTH, ORIGIN_Y + ARRAY_HEIGHT))
    return -1;

  sampling = (unsigned int)sensor_sampling(zoom_fact_width, zoom_fact_height);
  mode = sampling == 4 ? PO_6030_MODE_QQVGA : sampling == 2 ? PO_6030_MODE_QVGA : PO_6030_MODE_VGA;
  /* VSYNC comes a line earlier, HREF a pixel */
  sensor_y1 -= sampling;
  sensor_x1 -= IRQ_PIXELS * sampling;

  if (e_po6030k_set_wx(sensor_x1 / sampling, (ORIGIN_X + ARRAY_WIDTH + 1) / sampling)) return -1;
  if (e_po6030k_set_wy(sensor_y1 / sampling, (ORIGIN_Y + ARRAY_HEIGHT + 1) / sampling)) return -1;
  if (e_po6030k_set_vsync(sensor_y1, ORIGIN_Y + ARRAY_HEIGHT)) return -1;
  speed = sampling == 4 ? PO_6030_SPEED_2 : sampling == 2 ? PO_6030_SPEED_4 : PO_6030_SPEED_8;
  if (color_mode == GREY_SCALE_MODE)
    speed = sampling == 4 ? PO_6030_SPEED_1 : sampling == 2 ? PO_6030_SPEED_2 : PO_6030_SPEED_4;
  e_po6030k_set_speed(speed);
  if (e_po6030k_set_mode((unsigned char)color_mode, mode)) return -1;
  if (e_poxxxx_apply_timer_config(
          (int)(sensor_height / zoom_fact_height), (int)(sensor_width / zoom_fact_width),
          e_po6030k_get_bytes_per_pixel(color_mode), (int)(zoom_fact_width / sampling) - 1,
          (int)(zoom_fact_height / sampling) - 1))
    return -1;
  return 0;
}

void e_po6030k_set_sketch_mode(int mode) {
  int coloured = mode != E_PO6030K_SKETCH_BW;
  e_po6030k_write_register(BANK_C, 0x5A, 0x01);
  e_po6030k_write_register(BANK_B, 0x32, 0x41);
  e_po6030k_write_register(BANK_B, 0x88, coloured ? 0x20 : 0xFF);
  e_po6030k_write_register(BANK_B, 0x89, coloured ? 0x80 : 0xFF);
  e_po6030k_write_register(BANK_B, 0x8A, 0x08);
  e_po6030k_write_register(BANK_B, 0x8B, 0xFF);
}

void e_po6030k_set_mirror(int vertical, int horizontal) {
  unsigned char bits = e_po6030k_read_register(BANK_A, 0x90) & 0x3F;
  if (vertical) bits |= 0x80;
  if (horizontal) bits |= 0x40;
  e_po6030k_write_register(BANK_A, 0x90, bits);
}

void e_po6030k_set_awb_ae(int awb, int ae) {
  e_po6030k_write_register(BANK_C, 0x55, ae ? 0x8 : 0);
  e_po6030k_write_register(BANK_C, 0x56, ae ? 0xc : 0);
  e_po6030k_write_register(BANK_C, 0x4, (unsigned char)(0x98 | (awb ? 0 : 4) | (ae ? 0 : 1)));
}

void e_po6030k_set_rgb_gain(unsigned char r, unsigned char g, unsigned char b) {
  e_po6030k_write_register(BANK_C, 0xa4, r);
  e_po6030k_write_register(BANK_C, 0xa5, g);
  e_po6030k_write_register(BANK_C, 0xa6, b);
}

void e_po6030k_set_exposure(unsigned long exp) {
  e_po6030k_write_register(BANK_C, 0x2c, (unsigned char)(exp >> 24));
  e_po6030k_write_register(BANK_C, 0x2d, (unsigned char)(exp >> 16));
  e_po6030k_write_register(BANK_C, 0x2e, (unsigned char)(exp >> 8));
  e_po6030k_write_register(BANK_C, 0x2f, (unsigned char)exp);
}
