/* SPDX-License-Identifier: MIT
 * Instants of the line's interrupt, counted in e_line_interrupt.s, in cycles.
 *
 *   HREF rises, timer 4 counts it: 2 to 3     interrupt entry: 5     first byte taken: LINE_FIRST_SAMPLE later
 *
 * so the first byte is taken 17 or 18 cycles after the edge. A byte is on the pins for 8 cycles: that is the third one,
 * in colour the second pixel. The library sets the sensor's window a pixel wider at its left for that.
 * Source: [lib: camera/fast_2_timer/e_interrupt.s], counted.
 */
#ifndef HAL_DSPIC_CAMERA_LINE_H
#define HAL_DSPIC_CAMERA_LINE_H

#define LINE_FIRST_SAMPLE 10 /* from the handler's first instruction */
#define LINE_BYTE_CYCLES 8   /* from byte to byte, taken or skipped */

#endif
