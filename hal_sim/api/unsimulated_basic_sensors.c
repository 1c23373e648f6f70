/* SPDX-License-Identifier: MIT
 * Microphones, basic variant.
 */
#include "a_d/e_micro.h"
#include "unsimulated.h"

#define DEVICE "microphones"
UNSIMULATED_VOID(e_init_micro, (void))
UNSIMULATED_VOID(e_get_micro, (int *m1, int *m2, int *m3))
