/* SPDX-License-Identifier: MIT
 * The simulator's console.
 */
#ifndef WB_CONSOLE_H
#define WB_CONSOLE_H

#include "types.h"

#define WB_STDOUT 1
#define WB_STDERR 2

TP_C_BEGIN

/** Writes the text as printf() does. Nothing on the robot. Does not block. */
void wb_console_print(const char* text, int stream);

TP_C_END

#endif
