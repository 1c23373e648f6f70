/* SPDX-License-Identifier: MIT
 * Preparing samples for a transform. Pure computation, blocking for some cycles per element.
 */
#ifndef _FFT_UTILITIES
#define _FFT_UTILITIES

/** Makes complex numbers of `size` ints: writes x0, 0, x1, 0, ..., 2 * `size` words. */
void e_fast_copy(int *in_array, int *out_array, int size);

/** Subtracts the mean from each of `size` ints; `log2size` is its logarithm (the division is a shift). */
void e_subtract_mean(int *array, int size, int log2size);

#endif
