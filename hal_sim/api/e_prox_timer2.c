/* SPDX-License-Identifier: MIT
 * Proximity sensors, basic variant on Timer 2. Source: [lib: a_d/e_prox_timer2.c], facts restated.
 */
#define E_PROX_TIMER2
#include "a_d/e_prox.h"

#include "basic_prox.h"
