/* SPDX-License-Identifier: MIT
 * Proximity sensors, basic variant on Timer 1. Source: [lib: a_d/e_prox.c], facts restated.
 */
#include "a_d/e_prox.h"

#include "basic_prox.h"
