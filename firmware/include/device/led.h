/* SPDX-License-Identifier: MIT
 * LEDs: led0 to led7 the ring, led0 in front, clockwise; led8 body, led9 front.
 * Interface of 2005 to 2008.
 */
#ifndef DEVICE_LED_H
#define DEVICE_LED_H

#include "robot_types.h"

TP_C_BEGIN

/** 0 off, anything else on. Does not block. */
void led_set(DeviceTag tag, long value);

TP_C_END

#endif
