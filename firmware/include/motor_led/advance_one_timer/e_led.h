/* SPDX-License-Identifier: MIT
 * LEDs, advanced variant (the usual one): basic functions, blinking and effects to hang on agendas.
 * Nothing here blocks. Only e_start_led_blinking() needs running agendas.
 * Shares its guard with the basic e_led.h: the first one included decides which variant runs.
 */
#ifndef _LED
#define _LED

/** Ring LED `led_number` 0 to 7 clockwise, 0 in front; 8 and above means all eight.
 *  `value` 0 off, 1 on, above 1 toggles a single LED. For "all" only bit 0 counts, so (8, 2) switches all
 *  off; the basic variant toggles instead. */
void e_set_led(unsigned int led_number, unsigned int value);

/** All eight ring LEDs off; body and front LED stay. */
void e_led_clear(void);

/** Toggles all eight ring LEDs. Made to be an agenda. */
void e_blink_led(void);

/** Toggle one ring LED. Made to be agendas. */
void e_blink_led0(void);
void e_blink_led1(void);
void e_blink_led2(void);
void e_blink_led3(void);
void e_blink_led4(void);
void e_blink_led5(void);
void e_blink_led6(void);
void e_blink_led7(void);

/** Green body LED: 0 off, 1 on, above 1 toggles. With selector 10 the ADC driver pulses this pin. */
void e_set_body_led(unsigned int value);

/** Red front LED: 0 off, 1 on, above 1 toggles. With selector 10 the ADC driver pulses this pin. */
void e_set_front_led(unsigned int value);

/** Registers e_blink_led as an agenda of `cycle` x 0.1 ms: the ring toggles with that period. */
void e_start_led_blinking(int cycle);

/** Ends it; LEDs stay as they are. */
void e_stop_led_blinking(void);

/** One step of an animation per call, made to be agendas; each remembers where it is.
 *  flow: toggles 0, then 1 and 7, 2 and 6, 3 and 5, 4. snake: one LED runs clockwise. k2000: 0, 1, 0, 7, ...
 *  right and left: an arrow from front and back to one side, then all off. */
void flow_led(void);
void snake_led(void);
void k2000_led(void);
void right_led(void);
void left_led(void);

#endif
