/* SPDX-License-Identifier: MIT
 * IR proximity sensors, advanced variant (the usual one): reads what the ADC scan has filed; call
 * e_init_ad_scan(ALL_ADC) first. A sensor's value is fresh every 15.87 ms.
 *
 * Sensors are numbered clockwise from above; axes at 17, 46, 90, 151, 209, 270, 314, 343 degrees from the
 * front. Numbers 8 and 9 exist on the gumstix turret only.
 * Shares its guard with the basic e_prox.h: the first one included decides which variant runs.
 */
#ifndef _PROX
#define _PROX

#include "../../twinpuck.h"

/** Learns each sensor's reading in free space, to be subtracted by e_get_calibrated_prox(): the mean of 100
 *  readings. Nothing may stand within 15 cm. Blocks for about a second (counting loops). */
void e_calibrate_ir();

/** Reflected light, counts: dark sample minus lit sample; about 0 in free space, up to some thousand at
 *  contact; noise may make it slightly negative. 0 for sensors above 9. Does not block. */
int e_get_prox(unsigned int sensor_number);

/** The same minus the calibration, never below 0. Without calibration: e_get_prox() clipped at 0. */
int e_get_calibrated_prox(unsigned int sensor_number);

/** Dark sample, counts 0 to 4095: more light gives a lower value, darkness nearly 4095. 0 for sensors above
 *  9. */
int e_get_ambient_light(unsigned int sensor_number);

#endif
