/* SPDX-License-Identifier: MIT
 * The PO8030D: every setter chooses a bank (register 3) and writes to the sensor at once.
 *
 * Quirks kept: the window's lines are accepted and ignored, so every picture begins at the array's first
 * line; with sub-sampling a window at the array's left edge underflows in 16 bits and is refused (6); numbers
 * 1 to 10 say which check failed. Source: [lib: camera/fast_2_timer/e_po8030d_registers.c, e_calc_po8030d.c],
 * facts restated.
 */
#include "camera/fast_2_timer/e_po8030d.h"

#include "I2C/e_I2C_protocol.h"
#include "camera.h"

#define IRQ_PIXELS 1

/* in the library's object, not in its header */
unsigned char e_po8030d_read_register(unsigned char bank, unsigned char reg);
int enablePO8030();

void e_po8030d_set_bank(unsigned char bank) { hal_camera_set_bank(bank); }

void e_po8030d_write_register(unsigned char bank, unsigned char reg, unsigned char value) {
  hal_camera_write(bank, reg, value);
}

unsigned char e_po8030d_read_register(unsigned char bank, unsigned char reg) {
  return hal_camera_read(bank, reg);
}

int testWriteReg(unsigned char bank) { return e_po8030d_read_register(bank, CAMERA_BANK_REGISTER); }

int enablePO8030() {
  unsigned char pads = e_po8030d_read_register(BANK_A, 0x5B);
  e_i2cp_enable();
  e_i2cp_write((char)CAMERA_ADDRESS, 0x5B, (char)(pads & 0x37));
  e_i2cp_disable();
  return pads;
}

int init_po8030() {
  e_po8030d_write_register(BANK_A, 0x5B, 0x00); /* pads on */
  e_po8030d_set_brightness(0x28);
  return 0;
}

int e_po8030d_get_bytes_per_pixel(int color_mode) { return camera_bytes_per_pixel(color_mode); }

void e_po8030d_set_bayer_clkdiv(unsigned char div) { e_po8030d_write_register(BANK_A, 0x6A, div); }

void e_po8030d_set_pclkdiv(unsigned char div) { e_po8030d_write_register(BANK_B, 0xB7, div); }

int e_po8030d_set_mode(unsigned char format, unsigned char sampl_mode) {
  switch (format) {
    case GREY_SCALE_MODE:
      e_po8030d_write_register(BANK_B, 0x4E, 0x43);
      break;
    case RGB_565_MODE:
      e_po8030d_write_register(BANK_B, 0x4E, 0x30);
      break;
    case YUV_MODE:
      e_po8030d_write_register(BANK_B, 0x4E, 0x02);
      break;
    default:
      return -1;
  }
  if (sampl_mode != PO_8030_MODE_VGA && sampl_mode != PO_8030_MODE_QVGA && sampl_mode != PO_8030_MODE_QQVGA)
    return -1;
  e_po8030d_set_pclkdiv(format == GREY_SCALE_MODE ? 1 : 0);
  e_po8030d_write_register(BANK_B, 0x93, sampl_mode);
  e_po8030d_write_register(BANK_B, 0x94, sampl_mode);
  return 0;
}

int e_po8030d_set_wx(unsigned int start, unsigned int stop) {
  if (start >= stop || stop > 775) return -1;
  start--;
  e_po8030d_write_register(BANK_A, 0x09, (unsigned char)start);
  e_po8030d_write_register(BANK_A, 0x08, (unsigned char)(start >> 8));
  e_po8030d_write_register(BANK_A, 0x0C, (unsigned char)(stop >> 8));
  e_po8030d_write_register(BANK_A, 0x0D, (unsigned char)stop);
  return 0;
}

int e_po8030d_set_wy(unsigned int start, unsigned int stop) {
  (void)start;
  (void)stop;
  return 0;
}

int e_po8030d_set_vsync(unsigned int start, unsigned int stop) {
  if (start >= stop || stop > 515) return -1;
  e_po8030d_write_register(BANK_A, 0x10, (unsigned char)(start >> 8));
  e_po8030d_write_register(BANK_A, 0x11, (unsigned char)start);
  e_po8030d_write_register(BANK_A, 0x12, (unsigned char)(stop >> 8));
  e_po8030d_write_register(BANK_A, 0x13, (unsigned char)stop);
  return 0;
}

/** Four words to eight registers from `reg` on: columns from, to, lines from, to. */
static void write_window(unsigned char reg, const unsigned int words[4]) {
  int i;
  for (i = 0; i < 4; i++) {
    e_po8030d_write_register(BANK_A, (unsigned char)(reg + 2 * i), (unsigned char)(words[i] >> 8));
    e_po8030d_write_register(BANK_A, (unsigned char)(reg + 2 * i + 1), (unsigned char)words[i]);
  }
}

int e_po8030d_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                         unsigned int sensor_height, unsigned int zoom_fact_width,
                         unsigned int zoom_fact_height, int color_mode) {
  int grey = color_mode == GREY_SCALE_MODE;
  unsigned int sampling, window[4], centre[4], threshold;
  unsigned char mode;
  float wide;
  if (zoom_fact_height < 1 || zoom_fact_width < 1) return 1;
  if (sensor_x1 + sensor_width > ARRAY_WIDTH) return 2;
  if (sensor_y1 + sensor_height > ARRAY_HEIGHT) return 3;
  if (sensor_width % zoom_fact_width) return 4;
  if (sensor_height % zoom_fact_height) return 5;

  sampling = (unsigned int)sensor_sampling(zoom_fact_width, zoom_fact_height);
  mode = sampling == 4 ? PO_8030_MODE_QQVGA : sampling == 2 ? PO_8030_MODE_QVGA : PO_8030_MODE_VGA;
  sensor_y1 -= sampling;
  sensor_x1 -= IRQ_PIXELS * sampling;
  window[0] = sampling == 1 ? sensor_x1 : sensor_x1 / sampling + 1;
  window[1] = sensor_x1 + sensor_width / sampling - 1;
  window[2] = sampling == 1 ? sensor_y1 : sensor_y1 / sampling + 1;
  window[3] = sensor_y1 + sensor_height / sampling - 1;
  centre[0] = sensor_x1 + sensor_width / (3 * sampling);
  centre[1] = sensor_x1 + sensor_width * 2 / (3 * sampling);
  centre[2] = sensor_y1 + sensor_height / (3 * sampling);
  centre[3] = sensor_y1 + sensor_height * 2 / (3 * sampling);

  if (e_po8030d_set_wx(window[0], window[1])) return 6;
  if (e_po8030d_set_wy(window[2], window[3])) return 7;
  e_po8030d_write_register(BANK_A, 0x11, grey ? 0x03 : 0x0A);
  write_window(0x35, window); /* what the automatic exposure looks at, and its middle */
  write_window(0x3D, centre);
  e_po8030d_set_speed(grey ? PO_8030_SPEED_4 : PO_8030_SPEED_8);
  if (e_po8030d_set_mode((unsigned char)color_mode, mode)) return 9;

  wide = (float)(window[1] - window[0]);
  if (grey)
    threshold = (unsigned int)((648.0f - wide) * (wide + 8.0f) / 656.0f);
  else
    threshold = (unsigned int)((648.0f - wide) * 2.0f * (wide * 2.0f + 8.0f) / 1304.0f);
  e_po8030d_write_register(BANK_B, 0x95, (unsigned char)(threshold >> 8));
  e_po8030d_write_register(BANK_B, 0x96, (unsigned char)threshold);

  if (e_poxxxx_apply_timer_config(
          (int)(sensor_height / zoom_fact_height), (int)(sensor_width / zoom_fact_width),
          e_po8030d_get_bytes_per_pixel(color_mode), (int)(zoom_fact_width / sampling) - 1,
          (int)(zoom_fact_height / sampling) - 1))
    return 10;
  return 0;
}

void e_po8030d_set_sketch_mode(int mode) {
  if (mode != E_PO8030D_SKETCH_BW) return;
  e_po8030d_write_register(BANK_B, 0x04, 0x80);
  e_po8030d_write_register(BANK_B, 0x06, 0x02);
}

void e_po8030d_set_mirror(int vertical, int horizontal) {
  unsigned char bits = e_po8030d_read_register(BANK_A, 0x6C) & 0x3F;
  if (vertical) bits |= 0x80;
  if (horizontal) bits |= 0x40;
  e_po8030d_write_register(BANK_A, 0x6C, bits);
}

void e_po8030d_set_awb_ae(int awb, int ae) {
  e_po8030d_write_register(BANK_C, 0x48, ae ? 0x8 : 0);
  e_po8030d_write_register(BANK_C, 0x49, ae ? 0xc : 0);
  e_po8030d_write_register(BANK_C, 0x4, (unsigned char)(0x98 | (awb ? 0 : 4) | (ae ? 0 : 1)));
}

void e_po8030d_set_rgb_gain(unsigned char r, unsigned char g, unsigned char b) {
  e_po8030d_write_register(BANK_A, 0x23, r);
  e_po8030d_write_register(BANK_A, 0x24, g);
  e_po8030d_write_register(BANK_A, 0x25, b);
}

void e_po8030d_set_exposure(unsigned long exp) {
  e_po8030d_write_register(BANK_C, 0x12, (unsigned char)(exp >> 24));
  e_po8030d_write_register(BANK_C, 0x13, (unsigned char)(exp >> 16));
  e_po8030d_write_register(BANK_C, 0x14, (unsigned char)(exp >> 8));
  e_po8030d_write_register(BANK_C, 0x15, (unsigned char)exp);
}

void e_po8030d_set_brightness(signed char value) {
  e_po8030d_write_register(BANK_B, 0x9E, (unsigned char)value);
}
