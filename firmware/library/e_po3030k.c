/* SPDX-License-Identifier: MIT
 * The PO3030K: a table of 108 registers in memory that the setters edit, and the three functions that send
 * it.
 *
 * Quirks of the original that are kept: frame height sent as frame width; gamma and matrix setters take two
 * values (an array parameter is a pointer of two bytes); the parameters of set_max_min_exp are named in the
 * header in the other order than they are used; the lowest byte of the integration time is lost. Source:
 * [lib: camera/fast_2_timer/e_po3030k_registers.c, e_calc_po3030k.c], facts restated.
 */
#include "camera/fast_2_timer/e_po3030k.h"

#include "I2C/e_I2C_protocol.h"
#include "camera.h"
#include "hal.h"
#include "motor_led/e_epuck_ports.h"
#include "motor_led/e_init_port.h"

#define ORIGIN_X 210
#define ORIGIN_Y 7
#define IRQ_PIXELS 1 /* pixels that pass before the line's interrupt takes its first byte */
#define FRAME_WIDTH 0x0353
#define MASTER_CLOCK ((unsigned long)FCY)
#define FORMAT_GREY 0x0c
#define FORMAT_RGB565 0x08
#define FORMAT_YUV 0x02
#define POINTER_SIZE 2 /* what sizeof gives for an array parameter on the robot */

/* places in the table; registers whose numbers follow one another have one name */
enum {
  FRAME_SIZE = 0,
  WINDOW_X1 = 4,
  WINDOW_Y1 = 6,
  WINDOW_X2 = 8,
  WINDOW_Y2 = 10,
  BIAS = 12,
  GAINS = 14,
  INTEGRATION = 19,
  CLOCK = 22,
  MIRROR = 23,
  SAMPLING = 25,
  ADC_OFFSET = 26,
  FLICKER_MODE = 27,
  FLICKER_PERIODS = 29,
  FORMAT = 33,
  SEPIA = 34,
  LENS = 36,
  EDGE = 39,
  GAMMA = 41,
  MATRIX = 53,
  CB_CR = 62,
  BRIGHTNESS = 64,
  SEPIA_TONE = 66,
  VSYNC_START = 72,
  VSYNC_STOP = 74,
  VSYNC_COLUMN = 76,
  CENTRE_WEIGHT = 78,
  TOLERANCE = 79,
  AE_SPEED = 80,
  EXPOSURE = 81,
  TARGET = 84,
  EXPOSURE_LIMITS = 87,
  WHITE_LIMITS = 91,
  WEIGHT_WINDOW = 97,
  AUTOMATICS = 105,
  GAMMA_SELECT = 107,
  REGISTERS = 108
};

static const unsigned char address[REGISTERS] = {
    0x04, 0x05, 0x06, 0x07, 0x08, 0x09, 0x0a, 0x0b, 0x0c, 0x0d, 0x0e, 0x0f, 0x12, 0x13, 0x15, 0x16,
    0x17, 0x18, 0x19, 0x1a, 0x1b, 0x1c, 0x1d, 0x1e, 0x1f, 0x20, 0x3b, 0x46, 0x48, 0x49, 0x4a, 0x4b,
    0x4c, 0x4e, 0x4f, 0x50, 0x59, 0x5a, 0x5b, 0x5c, 0x5d, 0x76, 0x77, 0x78, 0x79, 0x7a, 0x7b, 0x7c,
    0x7d, 0x7e, 0x7f, 0x80, 0x81, 0x8e, 0x8f, 0x90, 0x91, 0x92, 0x93, 0x94, 0x95, 0x96, 0x97, 0x98,
    0x9b, 0x9c, 0x9f, 0xa0, 0xa1, 0xa2, 0xa3, 0xa4, 0xa5, 0xa6, 0xa7, 0xa8, 0xa9, 0xaa, 0xad, 0xae,
    0xaf, 0xb0, 0xb1, 0xb2, 0xb3, 0xb9, 0xba, 0xbb, 0xbc, 0xbd, 0xbe, 0xc1, 0xc2, 0xc3, 0xc4, 0xc5,
    0xc6, 0xc7, 0xc8, 0xc9, 0xca, 0xcb, 0xcc, 0xcd, 0xce, 0xd4, 0xd5, 0xd8};

static unsigned char value[REGISTERS] = {
    0x03,          0x53, 0x03, 0x53,                             /* frame size, twice its width */
    0x00,          0xd1, 0x00, 0x07,     0x03, 0x51, 0x01, 0xe7, /* window */
    0x02,          0x02,                                         /* bias */
    0x10,          0x40, 0x40, 0x40,     0x40,                   /* gains */
    0x03,          0xe6, 0x00,                                   /* integration */
    0x70,          0x0a, 0x1b, MODE_VGA, 0x00,                   /* clock, mirror, sampling, offset */
    0x80,          0x60, 0x96, 0x00,     0x7d, 0x00,             /* flicker */
    FORMAT_RGB565, 0x0a, 0x70,                                   /* format, sepia */
    0x00,          0x00, 0x00, 0xac,     0x02,                   /* lens, edges */
    0x00,          0x1a, 0x2a, 0x37,     0x42, 0x56, 0x68, 0x87, 0xa3, 0xbc, 0xd4, 0xea, /* gamma */
    0x38,          0xa5, 0x0d, 0x93,     0x2d, 0x06, 0x83, 0xaa, 0x4d, 0x25, 0x25, /* colour matrix, Cb, Cr */
    0x00,          0x96,                                                           /* brightness, contrast */
    0x80,          0x80, 0xb6, 0x9d,     0xab, 0x80,                               /* tone of the sepia */
    0x00,          0x07, 0x01, 0xe7,     0x00, 0x01,                               /* VSYNC */
    0x9f,          0x22, 0x8c, 0x07,     0xcc, 0x00, 0x70, 0x03, 0xe6, /* automatics: weight to target */
    0x07,          0xcc, 0x00, 0x0c,                                   /* limits of the exposure */
    0x10,          0xe0, 0x10, 0xe0,     0x80, 0x80,                   /* limits of the white balance */
    0x01,          0xa5, 0x02, 0x7a,     0x00, 0xa7, 0x01, 0x47,       /* weighted window */
    0x3c,          0x01, 0x80};

static void put_word(int place, unsigned int word) {
  value[place] = (unsigned char)(word >> 8);
  value[place + 1] = (unsigned char)word;
}

/* --- to the sensor and back */

void e_po3030k_write_cam_registers(void) { e_po3030k_sync_register_array(0x00, 0xff); }

void e_po3030k_read_cam_registers(void) {
  int i;
  e_i2cp_enable();
  for (i = 0; i < REGISTERS; i++)
    value[i] = (unsigned char)e_i2cp_read((char)CAMERA_ADDRESS, (char)address[i]);
  e_i2cp_disable();
}

int e_po3030k_sync_register_array(unsigned char start, unsigned char stop) {
  int i, sent = 0;
  e_i2cp_enable();
  for (i = 0; i < REGISTERS; i++) {
    if (address[i] < start || address[i] > stop) continue;
    e_i2cp_write((char)CAMERA_ADDRESS, (char)address[i], (char)value[i]);
    sent++;
  }
  e_i2cp_disable();
  return sent;
}

void e_po3030k_write_gamma_coef(void) {
  e_i2cp_enable();
  e_i2cp_write((char)CAMERA_ADDRESS, (char)address[GAMMA_SELECT], (char)value[GAMMA_SELECT]);
  e_i2cp_disable();
  e_po3030k_sync_register_array(address[GAMMA], address[GAMMA + 11]);
}

int e_po3030k_set_register(unsigned char adr, unsigned char v) {
  int i;
  for (i = 0; i < REGISTERS; i++)
    if (address[i] == adr) {
      value[i] = v;
      return 0;
    }
  return -1;
}

int e_po3030k_get_register(unsigned char adr, unsigned char* v) {
  int i;
  for (i = 0; i < REGISTERS; i++)
    if (address[i] == adr) {
      *v = value[i];
      return 0;
    }
  return -1;
}

/* --- picture */

int e_po3030k_get_bytes_per_pixel(int color_mode) { return camera_bytes_per_pixel(color_mode); }

int e_po3030k_set_color_mode(int mode) {
  switch (mode) {
    case GREY_SCALE_MODE:
      value[FORMAT] = FORMAT_GREY;
      return 0;
    case RGB_565_MODE:
      value[FORMAT] = FORMAT_RGB565;
      return 0;
    case YUV_MODE:
      value[FORMAT] = FORMAT_YUV;
      return 0;
  }
  return -1;
}

int e_po3030k_set_sampling_mode(int mode) {
  if (mode != MODE_VGA && mode != MODE_QVGA && mode != MODE_QQVGA) return -1;
  value[SAMPLING] = (unsigned char)mode;
  return 0;
}

int e_po3030k_set_speed(int mode) {
  /* 0x00 to 0x60 in steps of 0x10; SPEED_128 is forgotten in the original */
  if (mode & ~0x70 || mode == SPEED_128) return -1;
  value[CLOCK] = (unsigned char)mode;
  return 0;
}

int e_po3030k_set_wx(unsigned int start, unsigned int stop) {
  if (start >= stop || stop > 899) return -1;
  put_word(WINDOW_X1, start - 1);
  put_word(WINDOW_X2, stop);
  return 0;
}

int e_po3030k_set_wy(unsigned int start, unsigned int stop) {
  if (start >= stop || stop > 499) return -1;
  put_word(WINDOW_Y1, start);
  put_word(WINDOW_Y2, stop);
  return 0;
}

int e_po3030k_set_vsync(unsigned int start, unsigned int stop, unsigned int col) {
  if (start >= stop || stop > 499 || col > 899) return -1;
  put_word(VSYNC_START, start);
  put_word(VSYNC_STOP, stop);
  put_word(VSYNC_COLUMN, col);
  return 0;
}

void e_po3030k_set_mirror(int vertical, int horizontal) {
  value[MIRROR] = (unsigned char)(0x0a | (vertical ? 0x40 : 0) | (horizontal ? 0x80 : 0));
}

int e_po3030k_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                         unsigned int sensor_height, unsigned int zoom_fact_width,
                         unsigned int zoom_fact_height, int color_mode) {
  int sampling, mode, speed;
  sensor_x1 += ORIGIN_X;
  sensor_y1 += ORIGIN_Y;
  if (!camera_window_fits(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width, zoom_fact_height,
                          ORIGIN_X + ARRAY_WIDTH, ORIGIN_Y + ARRAY_HEIGHT))
    return -1;

  sampling = sensor_sampling(zoom_fact_width, zoom_fact_height);
  mode = sampling == 4 ? MODE_QQVGA : sampling == 2 ? MODE_QVGA : MODE_VGA;
  /* VSYNC comes a line earlier, HREF a pixel */
  sensor_y1 -= (unsigned int)sampling;
  sensor_x1 -= (unsigned int)(IRQ_PIXELS * sampling);

  if (e_po3030k_set_color_mode(color_mode)) return -1;
  if (e_po3030k_set_sampling_mode(mode)) return -1;
  speed = sampling == 4 ? SPEED_4 : sampling == 2 ? SPEED_8 : SPEED_16;
  if (color_mode == GREY_SCALE_MODE) speed = sampling == 4 ? SPEED_2 : sampling == 2 ? SPEED_4 : SPEED_8;
  e_po3030k_set_speed(speed);
  if (e_po3030k_set_wx(sensor_x1, ORIGIN_X + ARRAY_WIDTH + 1)) return -1;
  if (e_po3030k_set_wy(sensor_y1, ORIGIN_Y + ARRAY_HEIGHT + 1)) return -1;
  if (e_po3030k_set_vsync(sensor_y1, ORIGIN_Y + ARRAY_HEIGHT, sensor_x1 + 1)) return -1;
  if (e_poxxxx_apply_timer_config((int)(sensor_height / zoom_fact_height),
                                  (int)(sensor_width / zoom_fact_width),
                                  e_po3030k_get_bytes_per_pixel(color_mode),
                                  (int)zoom_fact_width / sampling - 1, (int)zoom_fact_height / sampling - 1))
    return -1;
  return 0;
}

/* of older versions of the library; the current one has e_poxxxx_init_cam() instead */
void e_po3030k_init_cam(void) {
  e_init_port();
  e_i2cp_init();
  hal_camera_reset();
}

/* --- light and colour */

void e_po3030k_set_bias(unsigned char pixbias, unsigned char opbias) {
  value[BIAS] = opbias;
  value[BIAS + 1] = pixbias;
}

int e_po3030k_set_color_gain(unsigned char global, unsigned char red, unsigned char green1,
                             unsigned char green2, unsigned char blue) {
  if (global > 79) return -1;
  value[GAINS] = global;
  value[GAINS + 1] = red;
  value[GAINS + 2] = green1;
  value[GAINS + 3] = blue;
  value[GAINS + 4] = green2;
  return 0;
}

void e_po3030k_set_integr_time(unsigned long time) {
  value[INTEGRATION] = (unsigned char)(time >> 14);
  value[INTEGRATION + 1] = (unsigned char)(time >> 6);
  value[INTEGRATION + 2] = 0; /* the original shifts these bits out of the byte */
}

void e_po3030k_set_adc_offset(unsigned char offset) { value[ADC_OFFSET] = offset; }

void e_po3030k_set_sepia(int status) {
  if (status)
    value[SEPIA] |= 0x80;
  else
    value[SEPIA] &= 0x7f;
}

void e_po3030k_set_lens_gain(unsigned char red, unsigned char green, unsigned char blue) {
  value[LENS] = red;
  value[LENS + 1] = green;
  value[LENS + 2] = blue;
}

void e_po3030k_set_edge_prop(unsigned char gain, unsigned char tresh) {
  value[EDGE] = (unsigned char)(0x50 + (gain & 0x1f));
  value[EDGE + 1] = tresh;
}

void e_po3030k_set_gamma_coef(unsigned char array[12], char color) {
  int i;
  value[GAMMA_SELECT] = (unsigned char)(0x80 + ((color & 3) << 5));
  for (i = 0; i < POINTER_SIZE; i++) value[GAMMA + i] = array[i];
}

/* the name under which the original defines it */
void e_po3030k_SetColorMatrix(unsigned char array[3 * 3]);

void e_po3030k_SetColorMatrix(unsigned char array[3 * 3]) {
  int i;
  for (i = 0; i < POINTER_SIZE; i++) value[MATRIX + i] = array[i];
}

void e_po3030k_set_color_matrix(unsigned char array[3 * 3]) { e_po3030k_SetColorMatrix(array); }

void e_po3030k_set_cb_cr_gain(unsigned char cg11c, unsigned char cg22c) {
  value[CB_CR] = cg11c;
  value[CB_CR + 1] = cg22c;
}

void e_po3030k_set_brigh_contr(unsigned char bright, unsigned char contrast) {
  value[BRIGHTNESS] = bright;
  value[BRIGHTNESS + 1] = contrast;
}

void e_po3030k_set_sepia_tone(unsigned char cb, unsigned char cr) {
  value[SEPIA_TONE] = cb;
  value[SEPIA_TONE + 1] = cr;
}

/* --- automatics */

void e_po3030k_set_ww(unsigned char ww) { value[CENTRE_WEIGHT] = (unsigned char)((ww << 4) + 0x0f); }

void e_po3030k_set_awb_ae_tol(unsigned char awbm, unsigned char aem) {
  value[TOLERANCE] = (unsigned char)((awbm << 4) + (aem & 0x0f));
}

void e_po3030k_set_ae_speed(unsigned char b, unsigned char d) {
  value[AE_SPEED] = (unsigned char)((d << 4) + (b & 0x0f));
}

void e_po3030k_set_exposure(long t) {
  value[EXPOSURE] = (unsigned char)(t >> 16);
  value[EXPOSURE + 1] = (unsigned char)(t >> 8);
  value[EXPOSURE + 2] = (unsigned char)t;
}

void e_po3030k_set_ref_exposure(unsigned char exp) { value[TARGET] = exp; }

void e_po3030k_set_max_min_exp(unsigned int max, unsigned int min) {
  put_word(EXPOSURE_LIMITS, max);
  put_word(EXPOSURE_LIMITS + 2, min);
}

void e_po3030k_set_max_min_awb(unsigned char minb, unsigned char maxb, unsigned char minr, unsigned char maxr,
                               unsigned char ratior, unsigned char ratiob) {
  value[WHITE_LIMITS] = minr;
  value[WHITE_LIMITS + 1] = maxr;
  value[WHITE_LIMITS + 2] = minb;
  value[WHITE_LIMITS + 3] = maxb;
  value[WHITE_LIMITS + 4] = ratior;
  value[WHITE_LIMITS + 5] = ratiob;
}

int e_po3030k_set_weight_win(unsigned int x1, unsigned int x2, unsigned int y1, unsigned int y2) {
  x1 += ORIGIN_X;
  x2 += ORIGIN_X;
  y1 += ORIGIN_Y;
  y2 += ORIGIN_Y;
  if (x2 > ORIGIN_X + ARRAY_WIDTH || y2 > ORIGIN_Y + ARRAY_HEIGHT) return -1;
  if (x1 >= x2 || y1 >= y2) return -1;
  if (x1 <= 421 || x2 >= 634 || y1 <= 167 || y2 >= 327) return -1;
  put_word(WEIGHT_WINDOW, x1);
  put_word(WEIGHT_WINDOW + 2, x2);
  put_word(WEIGHT_WINDOW + 4, y1);
  put_word(WEIGHT_WINDOW + 6, y2);
  return 0;
}

void e_po3030k_set_awb_ae(int awb, int ae) {
  value[AUTOMATICS] = (unsigned char)(0x0c | (awb ? 0x20 : 0) | (ae ? 0x10 : 0));
}

/* --- flicker */

void e_po3030k_set_flicker_mode(int manual) {
  if (manual)
    value[FLICKER_MODE] &= 0x7f;
  else
    value[FLICKER_MODE] |= 0x80;
}

void e_po3030k_set_flicker_detection(int hz50, int hz60) {
  value[FLICKER_MODE] =
      (unsigned char)((value[FLICKER_MODE] & ~0x60) | (hz50 ? 0 : 0x40) | (hz60 ? 0 : 0x20));
}

/* pixels a second as the original reckons them: twice as many in grey */
static unsigned long pixel_clock(void) {
  unsigned long clock;
  int speed = value[CLOCK] >> 4;
  if (value[CLOCK] & 0x8f) return 0;
  clock = speed == 0 ? MASTER_CLOCK / 2 : speed == 1 ? MASTER_CLOCK * 2 / 3 : MASTER_CLOCK >> speed;
  return value[FORMAT] == FORMAT_GREY ? clock * 2 : clock;
}

int e_po3030k_set_flicker_man_set(int hz50, int hz60, int fdm, int fk, int tol) {
  unsigned long lines;
  if (fk < 0 || fk > 3 || tol < 0 || tol > 3) return -1;
  lines =
      pixel_clock() * 2 * FRAME_WIDTH; /* more than 32 bits hold: the original's periods are what is left */
  put_word(FLICKER_PERIODS, (unsigned int)((long)lines / hz50));
  put_word(FLICKER_PERIODS + 2, (unsigned int)((long)lines / hz60));
  value[FLICKER_MODE] =
      (unsigned char)((value[FLICKER_MODE] & 0xe0) | (fdm ? 0x10 : 0) | (fk & 3) << 2 | (tol & 3));
  return 0;
}
