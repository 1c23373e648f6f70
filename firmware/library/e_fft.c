/* SPDX-License-Identifier: MIT
 * The library's transform: 256 points, in place, in natural order, divided by 256.
 * Source: [lib: fft/e_fft.c], facts restated.
 */
#include "fft/e_fft.h"

#define IN_PROGRAM_MEMORY __attribute__((__space__(auto_psv), __aligned__(FFT_BLOCK_LENGTH * 2)))

extern const fractcomplex IN_PROGRAM_MEMORY twiddleFactors[FFT_BLOCK_LENGTH / 2];

void e_doFFT_asm(fractcomplex *sigCmpx) {
  FFTComplexIP(LOG2_BLOCK_LENGTH, sigCmpx, (fractcomplex *)__builtin_psvoffset(twiddleFactors),
               (int)__builtin_psvpage(twiddleFactors));
  BitReverseComplex(LOG2_BLOCK_LENGTH, sigCmpx);
}
