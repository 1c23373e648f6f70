/* SPDX-License-Identifier: MIT
 * The slow camera driver of three timers that count the camera's edges: an interrupt for every byte.
 *
 *   VSYNC -> timer 5: timer 4 on     HREF -> timer 4: timer 1 on     pixel clock -> timer 1: one byte
 *
 * Timers 1, 4 and 5 at the priority of a reset. LED 0 toggles with every byte taken, as in the original.
 * Source: [lib: camera/slow_3_timer/e_timers.c], facts restated.
 */
#include "camera/slow_3_timer/e_po3030k.h"

#include "hal.h"

#define COUNT_EDGES 0x0002 /* external clock, prescaler 1 */

static char *volatile next_byte;
static volatile int ready;
static int rows, columns, bytes_per_pixel = 1, skipped_pixels, skipped_lines;
static int row;
static int pixels_left; /* of the line */
static int byte;        /* of the pixel, those of the skipped ones after it included */

void __attribute__((__interrupt__, __auto_psv__)) _T1Interrupt(void) {
  IFS0bits.T1IF = 0;
  TMR1 = 0;
  if (byte < bytes_per_pixel) {
    *next_byte = (char)(PORTD >> 8);
    next_byte++;
    if (LED0) LED0 = 0; else LED0 = 1;
  }
  if (++byte < bytes_per_pixel * (1 + skipped_pixels)) return;
  byte = 0;
  if (--pixels_left > 0) return;
  T1CONbits.TON = 0;
  if (++row == rows) {
    T4CONbits.TON = 0;
    ready = 1;
  }
}

void __attribute__((__interrupt__, __auto_psv__)) _T4Interrupt(void) {
  IFS1bits.T4IF = 0;
  TMR4 = 0;
  pixels_left = columns;
  byte = 0;
  TMR1 = 0;
  PR1 = 1;
  IFS0bits.T1IF = 0;
  IEC0bits.T1IE = 1;
  T1CONbits.TON = 1;
}

void __attribute__((__interrupt__, __auto_psv__)) _T5Interrupt(void) {
  IFS1bits.T5IF = 0;
  T5CONbits.TON = 0;
  TMR4 = (unsigned int)skipped_lines;
  PR4 = (unsigned int)skipped_lines + 1;
  IFS1bits.T4IF = 0;
  IEC1bits.T4IE = 1;
  T4CONbits.TON = 1;
}

void e_po3030k_launch_capture(char *buf) {
  T1CON = COUNT_EDGES;
  T4CON = COUNT_EDGES;
  T5CON = COUNT_EDGES;
  row = 0;
  next_byte = buf;
  ready = 0;
  TMR5 = 0;
  PR5 = 1;
  IFS0bits.T1IF = 0;
  IFS1bits.T4IF = 0;
  IFS1bits.T5IF = 0;
  IEC1bits.T5IE = 1;
  T5CONbits.TON = 1;
}

int e_po3030k_is_img_ready(void) { return ready; }

void e_po3030k_apply_timer_config(int pixel_row, int pixel_col, int bpp, int pbp, int bbl) {
  rows = pixel_row;
  columns = pixel_col;
  bytes_per_pixel = bpp;
  skipped_pixels = pbp;
  skipped_lines = bbl;
}
