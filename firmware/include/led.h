/* SPDX-License-Identifier: MIT
 * LEDs, as the library named them before 2006. Behaviour is that of motor_led/e_led.h; the guard is shared
 * with it.
 */
#ifndef _LED
#define _LED

/** Ring LED 0 to 7 clockwise, 8 and above all eight; value 0 off, 1 on, above 1 toggles. */
void SetLed(unsigned int led_number, unsigned int value);

/** All eight ring LEDs off. */
void LedClear(void);

/** Green body LED, red front LED: 0 off, 1 on, above 1 toggles. */
void SetBodyLed(unsigned int value);
void SetFrontLed(unsigned int value);

#endif
