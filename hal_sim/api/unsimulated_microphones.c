/* SPDX-License-Identifier: MIT
 * Microphones, advanced variant.
 */
#include "a_d/advance_ad_scan/e_micro.h"
#include "unsimulated.h"
#define DEVICE "microphone array"

UNSIMULATED(int, e_get_micro, (unsigned int micro_id))
UNSIMULATED(int, e_get_micro_average, (unsigned int micro_id, unsigned int filter_size))
UNSIMULATED(int, e_get_micro_volume, (unsigned int micro_id))

/* in the library's object, in none of its headers */
void e_get_micro_last_values(int micro_id, int *result, unsigned samples_nb);
UNSIMULATED_VOID(e_get_micro_last_values, (int micro_id, int *result, unsigned samples_nb))
