/* SPDX-License-Identifier: MIT
 * Preparing samples for a transform. Pure computation.
 */
#include "fft/e_fft_utilities.h"

void e_fast_copy(int *in_array, int *out_array, int size) {
  int i;
  for (i = 0; i < size; i++) {
    *out_array++ = in_array[i];
    *out_array++ = 0;
  }
}

void e_subtract_mean(int *array, int size, int log2size) {
  long sum = 0;
  int mean, i;
  for (i = 0; i < size; i++) sum += array[i];
  mean = (int)(sum >> log2size); /* the original shifts too, so the mean is rounded down */
  for (i = 0; i < size; i++) array[i] -= mean;
}
