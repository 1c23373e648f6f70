/* SPDX-License-Identifier: MIT
 * The display's font: small hard-edged characters of ASCII.
 */
#ifndef PROGRAMS_CONTROLLER_C_FONT_H
#define PROGRAMS_CONTROLLER_C_FONT_H

#define FONT_FIRST 32
#define FONT_LAST 126
#define FONT_COLUMNS 5
#define FONT_ROWS 7

/** Rows of a character from the top; of 5 bits the highest is on the left. */
extern const unsigned char kFont[FONT_LAST - FONT_FIRST + 1][FONT_ROWS];

#endif
