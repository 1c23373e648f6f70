/* SPDX-License-Identifier: MIT
 * LEDs, basic variant: no timer, no agenda. Nothing here blocks.
 * Shares its guard with the advanced e_led.h: the first one included decides which variant runs.
 */
#ifndef _LED
#define _LED

#include "../twinpuck.h"

/** Ring LED `led_number` 0 to 7 clockwise, 0 in front; 8 and above means all eight.
 *  `value` 0 off, 1 on, above 1 toggles (for "all": each LED by itself). */
void e_set_led(unsigned int led_number, unsigned int value) TP_VARIANT(tp_basic_, e_set_led);

/** All eight ring LEDs off; body and front LED stay. */
void e_led_clear(void) TP_VARIANT(tp_basic_, e_led_clear);

/** Green body LED: 0 off, 1 on, above 1 toggles. */
void e_set_body_led(unsigned int value) TP_VARIANT(tp_basic_, e_set_body_led);

/** Red front LED: 0 off, 1 on, above 1 toggles. */
void e_set_front_led(unsigned int value) TP_VARIANT(tp_basic_, e_set_front_led);

#endif
