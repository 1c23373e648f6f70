/* SPDX-License-Identifier: MIT
 * The camera, whichever sensor the robot carries, and the fast driver of two timers.
 *
 *   VSYNC -> timer 5 -> interrupt: timer 4 on          HREF -> timer 4 -> interrupt: copies one line's bytes
 *
 * Modelled: both interrupts at their instants and priority (6), the time a line's copying takes (8 cycles a
 * byte, taken or skipped, as the library's loop), dispatch by the identity found. Not modelled: an interrupt
 * that comes late takes the same bytes; on the robot it takes later ones. Source: [lib:
 * camera/fast_2_timer/e_common.c, e_timers.c, e_interrupt.s], facts restated.
 */
#include "camera/fast_2_timer/e_poxxxx.h"

#include "I2C/e_I2C_protocol.h"
#include "camera.h"
#include "camera/fast_2_timer/e_po3030k.h"
#include "camera/fast_2_timer/e_po6030k.h"
#include "camera/fast_2_timer/e_po8030d.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_camera.h"
#include "hal_sim/host/pins_eeprom.h"
#include "motor_led/e_init_port.h"
#include "p30F6014A.h"

#define PO3030K 0x3030u
#define PO6030K 0x6030u
#define PO8030D 0x8030u
#define MOUNT_WORD 0xFFFE /* last word of the data EEPROM */
#define UNKNOWN_SENSOR 11 /* answer of config_cam */

#define RESET_BIT 13          /* of port C */
#define RESET_LOOP_CYCLES 500 /* [estimated: 100 rounds of a counted loop with a nop] */
#define PRIORITY 6
#define MASK_CYCLES 8         /* a byte of the line, taken or skipped */
#define LINE_ENTRY_CYCLES 26  /* [estimated: entry, shadow registers, set-up, end of line, RETFIE] */
#define FRAME_ENTRY_CYCLES 30 /* [estimated: context, three bits, RETFIE] */
#define LAUNCH_CYCLES 60      /* [estimated: two timers set up] */
#define TAKE 1
#define SKIP 0
#define END_OF_LINE 2

/* the driver's public variables */
char* _poxxxx_buffer;
int _poxxxx_img_ready;
int _poxxxx_current_row;
int _poxxxx_row;
char _poxxxx_line_conf[LINE_CONF_SIZE];

static unsigned int camera_version;
static int columns, bytes_per_pixel, skipped_pixels, skipped_lines;

unsigned int getCameraVersion();

unsigned int getCameraVersion() { return camera_version; }

/* --- the driver --------------------------------------------------------------------------------------- */

static void line_interrupt(void) {
  static unsigned char line[LINE_CONF_SIZE];
  unsigned char* to = (unsigned char*)_poxxxx_buffer;
  int count = (int)tp_camera_take_line(line, sizeof line);
  int i;
  for (i = 0; i < count; i++) *to++ = line[i];
  _poxxxx_buffer = (char*)to;
  /* the bytes between those that are taken take as long */
  tp_spend((tp_i64)MASK_CYCLES * columns * bytes_per_pixel * skipped_pixels);
  if (++_poxxxx_current_row == _poxxxx_row)
    _poxxxx_img_ready = 1;
  else
    tp_irq_at(TP_V_T4, tp_camera_next_line());
}

static void frame_interrupt(void) { tp_irq_at(TP_V_T4, tp_camera_begin_frame()); }

void e_poxxxx_launch_capture(char* buf) {
  tp_spend(LAUNCH_CYCLES);
  _poxxxx_current_row = 0;
  _poxxxx_buffer = buf;
  _poxxxx_img_ready = 0;
  tp_irq_install(TP_V_T4, line_interrupt, PRIORITY, LINE_ENTRY_CYCLES);
  tp_irq_install(TP_V_T5, frame_interrupt, PRIORITY, FRAME_ENTRY_CYCLES);
  tp_irq_at(TP_V_T4, -1);
  tp_irq_at(TP_V_T5,
            tp_camera_launch(_poxxxx_row, columns, bytes_per_pixel, skipped_pixels, skipped_lines, 0));
}

int e_poxxxx_is_img_ready(void) { return _poxxxx_img_ready; }

int e_poxxxx_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl) {
  int i, j, at = 0;
  if ((unsigned int)(pixel_col * bpp * (1 + pbp) + 1) > LINE_CONF_SIZE) return -1;
  for (i = 0; i < pixel_col; i++)
    for (j = 0; j < bpp * (1 + pbp); j++) _poxxxx_line_conf[at++] = j < bpp ? TAKE : SKIP;
  _poxxxx_line_conf[at] = END_OF_LINE;
  columns = pixel_col;
  bytes_per_pixel = bpp;
  skipped_pixels = pbp;
  skipped_lines = bbl;
  _poxxxx_row = pixel_row;
  return 0;
}

/* --- whichever sensor it is --------------------------------------------------------------------------- */

int e_poxxxx_init_cam(void) {
  unsigned int high, low;
  e_init_port();
  e_i2cp_init();
  tp_latch_write('C', RESET_BIT, 1); /* so that there is an edge, however the pin stood */
  tp_latch_write('C', RESET_BIT, 0);
  tp_spend(RESET_LOOP_CYCLES);
  tp_latch_write('C', RESET_BIT, 1);
  tp_spend(RESET_LOOP_CYCLES);
  INTCON1bits.NSTDIS = 0;
  IPC5 = (IPC5 & 0xF00F) + 0x0660;
  high = (unsigned char)e_i2cp_read((char)CAMERA_ADDRESS, 0);
  low = (unsigned char)e_i2cp_read((char)CAMERA_ADDRESS, 1);
  camera_version = high << 8 | low;
  switch (camera_version) {
    case PO3030K:
      e_poxxxx_set_mirror(0, 0);
      break;
    case PO6030K:
      e_poxxxx_set_mirror(1, 1);
      break;
    case PO8030D:
      e_poxxxx_set_mirror(0, 0);
      init_po8030();
      break;
  }
  e_poxxxx_write_cam_registers();
  return (int)camera_version;
}

int e_poxxxx_config_cam(unsigned int sensor_x1, unsigned int sensor_y1, unsigned int sensor_width,
                        unsigned int sensor_height, unsigned int zoom_fact_width,
                        unsigned int zoom_fact_height, int color_mode) {
  switch (camera_version) {
    case PO3030K:
      return e_po3030k_config_cam(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width,
                                  zoom_fact_height, color_mode);
    case PO6030K:
      return e_po6030k_config_cam(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width,
                                  zoom_fact_height, color_mode);
    case PO8030D:
      return e_po8030d_config_cam(sensor_x1, sensor_y1, sensor_width, sensor_height, zoom_fact_width,
                                  zoom_fact_height, color_mode);
  }
  return UNKNOWN_SENSOR;
}

void e_poxxxx_set_mirror(int vertical, int horizontal) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_mirror(vertical, horizontal);
      break;
    case PO6030K:
      e_po6030k_set_mirror(vertical, horizontal);
      break;
    case PO8030D:
      e_po8030d_set_mirror(vertical, horizontal);
      break;
  }
}

void e_poxxxx_write_cam_registers(void) {
  if (camera_version == PO3030K) e_po3030k_write_cam_registers();
}

int e_poxxxx_get_orientation(void) {
  switch (camera_version) {
    case PO3030K:
      switch ((int)tp_eeprom_read(MOUNT_WORD) & 3) {
        case 2:
          return 2;
        case 3:
          return 0;
      }
      return 1; /* 1 says so, and 0 falls through to the other sensors in the original */
    case PO6030K:
    case PO8030D:
      return 1;
  }
  return -1;
}

void e_poxxxx_set_awb_ae(int awb, int ae) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_awb_ae(awb, ae);
      break;
    case PO6030K:
      e_po6030k_set_awb_ae(awb, ae);
      break;
    case PO8030D:
      e_po8030d_set_awb_ae(awb, ae);
      break;
  }
}

void e_poxxxx_set_rgb_gain(unsigned char r, unsigned char g, unsigned char b) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_color_gain(40, r, g, g, b);
      break;
    case PO6030K:
      e_po6030k_set_rgb_gain(r, g, b);
      break;
    case PO8030D:
      e_po8030d_set_rgb_gain(r, g, b);
      break;
  }
}

void e_poxxxx_set_exposure(unsigned long exp) {
  switch (camera_version) {
    case PO3030K:
      e_po3030k_set_exposure((long)exp);
      break;
    case PO6030K:
      e_po6030k_set_exposure(exp);
      break;
    case PO8030D:
      e_po8030d_set_exposure(exp);
      break;
  }
}
