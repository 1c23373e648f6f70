/* SPDX-License-Identifier: MIT
 * LEDs: led0 to led7 the ring, led0 in front, clockwise; led8 body, led9 front. Nothing here blocks.
 */
#ifndef WB_LED_H
#define WB_LED_H

#include "types.h"

TP_C_BEGIN

/** 0 off, anything else on; these LEDs have one colour. */
void wb_led_set(WbDeviceTag tag, long value);

/** What was set. */
int wb_led_get(WbDeviceTag tag);

TP_C_END

#endif
