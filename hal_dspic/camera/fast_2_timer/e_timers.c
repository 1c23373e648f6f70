/* SPDX-License-Identifier: MIT
 * The fast camera driver of two timers that count the camera's edges.
 *
 *   VSYNC -> timer 5 -> interrupt: timer 4 on        HREF -> timer 4 -> interrupt: copies one line's bytes
 *
 * A byte of a line is on the pins for 8 cycles, so the copying is counted by cycles: e_line_interrupt.s.
 * Priority 6: nothing but the camera's own interrupts may delay a line.
 * Source: [lib: camera/fast_2_timer/e_timers.c, e_interrupt.s], facts restated.
 */
#include "camera/fast_2_timer/e_poxxxx.h"

#include "camera_line.h"
#include "hal.h"
#include "firmware/library/camera.h"

#define COUNT_EDGES 0x0002 /* external clock, prescaler 1 */

/* the driver's public variables; the line's interrupt works on them */
char *_poxxxx_buffer;
volatile int _poxxxx_img_ready;
int _poxxxx_current_row;
int _poxxxx_row;
char _poxxxx_line_conf[LINE_CONF_SIZE];

static int skipped_lines;

void __attribute__((__interrupt__, __auto_psv__)) _T5Interrupt(void) {
  IFS1bits.T5IF = 0;
  T5CONbits.TON = 0;
  /* the first line counts at once, then every (skipped + 1)-th */
  TMR4 = (unsigned int)skipped_lines;
  PR4 = (unsigned int)skipped_lines + 1;
  IFS1bits.T4IF = 0;
  IEC1bits.T4IE = 1;
  T4CONbits.TON = 1;
}

/* The handler has an archive member of its own, which a linker takes only when something names it: vectors do not, and
 * _T4Interrupt is the slow camera's handler, too. */
extern void twinpuck_line_handler(void);
extern void (*const twinpuck_line_interrupt)(void);
void (*const twinpuck_line_interrupt)(void) = twinpuck_line_handler;

void e_poxxxx_launch_capture(char *buf) {
  T4CON = COUNT_EDGES;
  T5CON = COUNT_EDGES;
  _poxxxx_current_row = 0;
  _poxxxx_buffer = buf;
  _poxxxx_img_ready = 0;
  TMR5 = 0;
  PR5 = 1;
  IFS1bits.T4IF = 0;
  IFS1bits.T5IF = 0;
  IEC1bits.T5IE = 1;
  T5CONbits.TON = 1;
}

int e_poxxxx_is_img_ready(void) { return _poxxxx_img_ready; }

int e_poxxxx_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl) {
  if (camera_fill_line_conf(_poxxxx_line_conf, pixel_col, bpp, pbp)) return -1;
  skipped_lines = bbl;
  _poxxxx_row = pixel_row;
  return 0;
}
