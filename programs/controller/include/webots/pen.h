/* SPDX-License-Identifier: MIT
 * Pens. The floor takes no ink: where the world has a pen, nothing happens; else each function warns of its
 * tag.
 */
#ifndef WB_PEN_H
#define WB_PEN_H

#include <webots/types.h>

TP_C_BEGIN

void wb_pen_write(WbDeviceTag tag, bool write);
/** 0xRRGGBB; density 0 to 1. */
void wb_pen_set_ink_color(WbDeviceTag tag, int color, double density);

TP_C_END

#endif
