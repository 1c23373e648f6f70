/* SPDX-License-Identifier: MIT
 * IR proximity sensors on timer 1, as the library named them before 2006. Behaviour is that of a_d/e_prox.h;
 * the guard is shared with it.
 */
#ifndef _PROX
#define _PROX

#include "twinpuck.h"

/** Configures the converter and starts timer 1. */
void InitProx(void);

/** Reflected light, counts, sensor 0 to 7. */
int GetProx(unsigned int sensor_number);

/** Dark sample, counts 0 to 4095, lower with more light. */
int GetAmbientLight(unsigned int sensor_number);

#endif
