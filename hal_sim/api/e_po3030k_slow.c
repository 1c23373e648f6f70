/* SPDX-License-Identifier: MIT
 * The slow driver of three timers: an interrupt for every byte, clocks 16 to 128 times slower than the fast
 * driver's.
 *
 * Modelled: frames, lines and bytes at the slow clock, LED 0 that toggles with every byte taken, the
 * processor time of the bytes' interrupts (spent at once when a line begins). Not modelled: what happens to
 * single bytes when the processor is kept from an interrupt. Source: [lib: camera/slow_3_timer/], facts
 * restated. The settings are those of e_po3030k.c.
 */
#include "camera/slow_3_timer/e_po3030k.h"

#include "firmware/library/camera.h"
#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_camera.h"

#define PRIORITY 4        /* as after a reset: this driver sets none */
#define LONGEST_LINE 1280 /* 640 pixels of two bytes */
#define LED0_BIT 6        /* of port A */

static char* next_byte;
static int ready, row;
static int rows, columns, bytes_per_pixel = 1, skipped_pixels, skipped_lines;
static char led_is_off = 1;

TAKES(0) static void line_interrupt(void) {
  static unsigned char line[LONGEST_LINE];
  int i, count = (int)tp_camera_take_line(line, sizeof line);
  for (i = 0; i < count; i++) {
    *next_byte++ = (char)line[i];
    tp_latch_write('A', LED0_BIT, led_is_off);
    led_is_off = !led_is_off;
  }
  tp_spend((tp_i64)columns * bytes_per_pixel * (T_SLOW_BYTE + T_SLOW_SKIPPED * skipped_pixels));
  if (++row == rows)
    ready = 1;
  else
    tp_irq_at(TP_V_T4, tp_camera_next_line());
}

TAKES(0) static void frame_interrupt(void) { tp_irq_at(TP_V_T4, tp_camera_begin_frame()); }

TAKES(T_SLOW_LAUNCH) void e_po3030k_launch_capture(char* buf) {
  row = 0;
  next_byte = buf;
  ready = 0;
  tp_irq_install(TP_V_T4, line_interrupt, PRIORITY, T_SLOW_LINE);
  tp_irq_install(TP_V_T5, frame_interrupt, PRIORITY, T_SLOW_FRAME);
  tp_irq_at(TP_V_T4, -1);
  tp_irq_at(TP_V_T5, tp_camera_launch(rows, columns, bytes_per_pixel, skipped_pixels, skipped_lines, 1));
}

int e_po3030k_is_img_ready(void) { return ready; }

void e_po3030k_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl) {
  rows = pixel_row;
  columns = pixel_col;
  bytes_per_pixel = bpp;
  skipped_pixels = pbp;
  skipped_lines = bbl;
}
