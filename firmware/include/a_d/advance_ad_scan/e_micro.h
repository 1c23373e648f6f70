/* SPDX-License-Identifier: MIT
 * Microphones, advanced variant: reads what the ADC scan has filed; call e_init_ad_scan() first. Nothing here
 * blocks. Microphone 0 is on the right, 1 on the left, 2 behind. 16384 samples a second each (32768 with
 * MICRO_ONLY), 0 to 4095, silence at about 2000.
 */
#ifndef _MICRO
#define _MICRO

#include "../../twinpuck.h"

#define MIC0_BUFFER 0
#define MIC1_BUFFER 1
#define MIC2_BUFFER 2

/** The oldest sample in the buffer, about 6.1 ms old, counts. `micro_id` 0 to 2, unchecked. */
int e_get_micro(unsigned int micro_id);

/** Mean of the oldest sample and the newest `filter_size` - 1; size 1 to MIC_SAMP_NB, larger gives 0.
 *  Size 0 divides by zero: math-error trap. */
int e_get_micro_average(unsigned int micro_id, unsigned int filter_size);

/** Highest minus lowest sample in the buffer, counts 0 to 4095. A buffer that only rises gives a wrong lowest
 *  value, as in the original. */
int e_get_micro_volume(unsigned int micro_id);

/* Also in the library, undeclared as in the original:
 *   void e_get_micro_last_values(int micro_id, int *result, unsigned samples_nb);   copies the oldest
 *   samples, the oldest last; the whole buffer with MIC_SAMP_NB, nothing beyond
 */

#endif
