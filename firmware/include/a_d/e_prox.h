/* SPDX-License-Identifier: MIT
 * IR proximity sensors, basic variant: timer 1 walks through the four pairs (0,4) (1,5) (2,6) (3,7). For each
 * pair it samples in the dark, lights the LEDs, samples again 350.5 us later and rests for 2100.2 us; all
 * eight are fresh every 9.80 ms. Its interrupt (priority 4) makes two conversions and so blocks the program
 * for them.
 *
 * A twin of this driver runs on timer 2: define E_PROX_TIMER2 before this header, or on the command line.
 * Timer 1 is then free; agendas, which need timer 2, are not.
 *
 * Sensors are numbered clockwise from above; axes at 17, 46, 90, 151, 209, 270, 314, 343 degrees from the
 * front. Shares its guard with the advanced e_prox.h: the first one included decides which variant runs.
 */
#ifndef _PROX
#define _PROX

#include "../twinpuck.h"

#ifdef E_PROX_TIMER2
#define TP_PROX(name) TP_VARIANT(tp_t2_, name)
#else
#define TP_PROX(name) TP_VARIANT(tp_basic_, name)
#endif

/** Configures the converter (e_init_ad()) and starts the timer. Does not block; values are 0 until
 *  sampled. */
void e_init_prox(void) TP_PROX(e_init_prox);

/** Stops the timer and switches the IR LEDs off; the last values stay readable. */
void e_stop_prox(void) TP_PROX(e_stop_prox);

/** Reflected light, counts: dark sample minus lit sample; about 0 in free space, up to some thousand at
 *  contact; noise may make it slightly negative. `sensor_number` 0 to 7; 0 for larger numbers. Does not
 *  block. */
int e_get_prox(unsigned int sensor_number) TP_PROX(e_get_prox);

/** Dark sample, counts 0 to 4095: more light gives a lower value, darkness nearly 4095. 0 for sensors above
 *  7. */
int e_get_ambient_light(unsigned int sensor_number) TP_PROX(e_get_ambient_light);

#undef TP_PROX
#endif
