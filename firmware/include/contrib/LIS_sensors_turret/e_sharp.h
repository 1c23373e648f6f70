/* SPDX-License-Identifier: MIT
 * Sharp distance sensor and five LEDs of the LIS turret. Its pins are also those of the selector (RG6 to RG9)
 * and of the accelerometer (RB6, RB7).
 */
#ifndef _SHARP
#define _SHARP

#define SHARP 5 /* analogue channel */

#define SHARP_LED1 _LATG6
#define SHARP_LED2 _LATG7
#define SHARP_LED3 _LATG8
#define SHARP_LED4 _LATG9
#define SHARP_LED5 _LATB6
#define SHARP_VIN _LATB7 /* supply, active low */
#define SHARP_LED1_DIR _TRISG6
#define SHARP_LED2_DIR _TRISG7
#define SHARP_LED3_DIR _TRISG8
#define SHARP_LED4_DIR _TRISG9
#define SHARP_LED5_DIR _TRISB6
#define SHARP_VIN_DIR _TRISB7

/** Pin directions, converter, LEDs off, supply off. */
void e_init_sharp(void);

/** The sensor's voltage, counts: nearer is higher. It comes in on the accelerometer's x channel and is read by
 *  e_get_acc(0). */
int e_get_dist_sharp(void);

/** LED 1 to 5: 0 off, 1 on, above 1 toggles. */
void e_set_sharp_led(unsigned int sharp_led_number, unsigned int value);

/** All five off. */
void e_sharp_led_clear(void);

/** Supply of the sensor; the first value is good about 30 ms after switching on. */
void e_sharp_on(void);
void e_sharp_off(void);

#endif
