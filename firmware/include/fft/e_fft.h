/* SPDX-License-Identifier: MIT
 * Complex fast Fourier transform in 16-bit fractions.
 */
#ifndef FFT_H
#define FFT_H

#include "../dsp.h"

/** Points of the transform: 64, 128, 256 or 512. */
#define FFT_BLOCK_LENGTH 256

#if (FFT_BLOCK_LENGTH == 64)
#define LOG2_BLOCK_LENGTH 6
#endif
#if (FFT_BLOCK_LENGTH == 128)
#define LOG2_BLOCK_LENGTH 7
#endif
#if (FFT_BLOCK_LENGTH == 256)
#define LOG2_BLOCK_LENGTH 8
#endif
#if (FFT_BLOCK_LENGTH == 512)
#define LOG2_BLOCK_LENGTH 9
#endif

/** Transforms FFT_BLOCK_LENGTH points in place, result in natural order, divided by the number of points.
 *  Blocks for some milliseconds. The array must be aligned to its size. */
void e_doFFT_asm(fractcomplex *sigCmpx);

#endif
