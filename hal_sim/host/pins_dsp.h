/* SPDX-License-Identifier: MIT
 * Arithmetic of the processor's DSP engine on arrays of the firmware: 16-bit fractions, 40-bit accumulators.
 * Only the result; the time is charged by the caller. Pointers must be valid (the caller touches both ends
 * first).
 */
#ifndef TWINPUCK_HOST_PINS_DSP_H
#define TWINPUCK_HOST_PINS_DSP_H
#include "image_abi.h"
#ifdef __cplusplus
extern "C" {
#endif

/** Complex transform of 2^log2n points in place, decimation in frequency: every stage halves, results are in
 * bit-reversed order. data: 2^log2n pairs of 16-bit words (real, imaginary); twiddles: half as many pairs.
 * log2n 1 to 12; others change nothing. Write. */
void tp_dsp_fft(tp_i64 log2n, void* data, const void* twiddles);
/** Exchanges pairs so that bit-reversed order becomes natural order, or back. Write. */
void tp_dsp_bit_reverse(tp_i64 log2n, void* data);

#ifdef __cplusplus
}
#endif
#endif
