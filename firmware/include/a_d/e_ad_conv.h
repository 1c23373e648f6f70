/* SPDX-License-Identifier: MIT
 * Analogue inputs, basic variant: one conversion at a time, by hand, no interrupt.
 * Shares its guard with the advanced e_ad_conv.h. Do not use both: they program the same converter
 * differently.
 */
#ifndef _AD_CONV
#define _AD_CONV

#include "../twinpuck.h"

/** Configures the converter: 12 bits, inputs AN2 to AN15 analogue. Does not block. */
void e_init_ad(void) TP_VARIANT(tp_basic_, e_init_ad);

/** Converts channel 0 to 15 (IR0, MIC1, ACCX, ... of e_epuck_ports.h) and returns 0 to 4095; 0 for a channel
 *  above 15. Blocks for some tens of microseconds: settling delay and 14 converter clocks. */
int e_read_ad(unsigned int channel) TP_VARIANT(tp_basic_, e_read_ad);

#endif
