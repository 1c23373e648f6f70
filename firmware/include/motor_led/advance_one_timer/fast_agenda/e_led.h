/* SPDX-License-Identifier: MIT
 * LEDs for the fast agendas: the advanced variant without the five effects. Nothing here blocks.
 * Shares its guard with the other two e_led.h: the first one included decides which variant runs.
 */
#ifndef _LED
#define _LED

#include "../../../twinpuck.h"

/** Ring LED `led_number` 0 to 7 clockwise, 0 in front; 8 and above means all eight.
 *  `value` 0 off, 1 on, above 1 toggles a single LED; for "all" only bit 0 counts. */
void e_set_led(unsigned int led_number, unsigned int value) TP_VARIANT(tpfast_, e_set_led);

/** All eight ring LEDs off; body and front LED stay. */
void e_led_clear(void) TP_VARIANT(tpfast_, e_led_clear);

/** Toggles all eight ring LEDs. Made to be an agenda. */
void e_blink_led(void) TP_VARIANT(tpfast_, e_blink_led);

/** Toggle one ring LED. Made to be agendas. */
void e_blink_led0(void) TP_VARIANT(tpfast_, e_blink_led0);
void e_blink_led1(void) TP_VARIANT(tpfast_, e_blink_led1);
void e_blink_led2(void) TP_VARIANT(tpfast_, e_blink_led2);
void e_blink_led3(void) TP_VARIANT(tpfast_, e_blink_led3);
void e_blink_led4(void) TP_VARIANT(tpfast_, e_blink_led4);
void e_blink_led5(void) TP_VARIANT(tpfast_, e_blink_led5);
void e_blink_led6(void) TP_VARIANT(tpfast_, e_blink_led6);
void e_blink_led7(void) TP_VARIANT(tpfast_, e_blink_led7);

/** Green body LED, red front LED: 0 off, 1 on, above 1 toggles. */
void e_set_body_led(unsigned int value) TP_VARIANT(tpfast_, e_set_body_led);
void e_set_front_led(unsigned int value) TP_VARIANT(tpfast_, e_set_front_led);

/** Registers e_blink_led as a task of `cycle` x 0.1 ms. */
void e_start_led_blinking(int cycle) TP_VARIANT(tpfast_, e_start_led_blinking);

/** Ends it; LEDs stay as they are. */
void e_stop_led_blinking(void) TP_VARIANT(tpfast_, e_stop_led_blinking);

#endif
