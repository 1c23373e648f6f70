/* SPDX-License-Identifier: MIT
 * The fast camera driver of two timers.
 *
 *   VSYNC -> timer 5 -> interrupt: timer 4 on          HREF -> timer 4 -> interrupt: copies one line's bytes
 *
 * Modelled: both interrupts at their instants and priority (6), the time a line's copying takes (8 cycles a
 * byte, taken or skipped, as the library's loop). Not modelled: an interrupt that comes late takes the same bytes; on
 * the robot it takes later ones. Source: [lib: camera/fast_2_timer/e_timers.c, e_interrupt.s], facts restated.
 */
#include "camera/fast_2_timer/e_poxxxx.h"

#include "firmware/library/camera.h"
#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_camera.h"

#define PRIORITY 6
#define MASK_CYCLES 8 /* a byte of the line, taken or skipped */

/* the driver's public variables */
char* _poxxxx_buffer;
int _poxxxx_img_ready;
int _poxxxx_current_row;
int _poxxxx_row;
char _poxxxx_line_conf[LINE_CONF_SIZE];

static int columns, bytes_per_pixel, skipped_pixels, skipped_lines;

TAKES(0) static void line_interrupt(void) {
  static unsigned char line[LINE_CONF_SIZE];
  unsigned char* to = (unsigned char*)_poxxxx_buffer;
  int count = (int)tp_camera_take_line(line, sizeof line);
  int i;
  for (i = 0; i < count; i++) *to++ = line[i];
  _poxxxx_buffer = (char*)to;
  tp_spend((tp_i64)MASK_CYCLES * columns * bytes_per_pixel * (1 + skipped_pixels));
  if (++_poxxxx_current_row == _poxxxx_row)
    _poxxxx_img_ready = 1;
  else
    tp_irq_at(TP_V_T4, tp_camera_next_line());
}

TAKES(0) static void frame_interrupt(void) { tp_irq_at(TP_V_T4, tp_camera_begin_frame()); }

TAKES(T_CAMERA_LAUNCH) void e_poxxxx_launch_capture(char* buf) {
  _poxxxx_current_row = 0;
  _poxxxx_buffer = buf;
  _poxxxx_img_ready = 0;
  tp_irq_install(TP_V_T4, line_interrupt, PRIORITY, T_CAMERA_LINE);
  tp_irq_install(TP_V_T5, frame_interrupt, PRIORITY, T_CAMERA_FRAME);
  tp_irq_at(TP_V_T4, -1);
  tp_irq_at(TP_V_T5,
            tp_camera_launch(_poxxxx_row, columns, bytes_per_pixel, skipped_pixels, skipped_lines, 0));
}

int e_poxxxx_is_img_ready(void) { return _poxxxx_img_ready; }

int e_poxxxx_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl) {
  if (camera_fill_line_conf(_poxxxx_line_conf, pixel_col, bpp, pbp)) return -1;
  columns = pixel_col;
  bytes_per_pixel = bpp;
  skipped_pixels = pbp;
  skipped_lines = bbl;
  _poxxxx_row = pixel_row;
  return 0;
}
