/* SPDX-License-Identifier: MIT
 * Instants of the line's interrupt, counted in e_line_interrupt.s, in cycles.
 *
 *   HREF rises, timer 4 counts it: 2 to 3     interrupt entry: 5     first byte taken: LINE_FIRST_SAMPLE later
 *
 * so the first byte is taken 26 to 30 cycles after the edge, which is the pixel after the first: the sensor's window is
 * set a pixel wider at its left for that.
 */
#ifndef HAL_DSPIC_CAMERA_LINE_H
#define HAL_DSPIC_CAMERA_LINE_H

#define LINE_FIRST_SAMPLE 20 /* from the handler's first instruction */
#define LINE_BYTE_CYCLES 8   /* from byte to byte, taken or skipped */

#endif
