/* SPDX-License-Identifier: MIT
 * The transforms of Microchip's signal-processing library, for our own compiler: with XC16 the vendor's, which
 * is assembler for the DSP engine, is linked (-ldsp). The same arithmetic:
 *
 *   upper' = round((a + b) / 2)                   a, b: upper and lower leg
 *   lower' = round((a - b) w / 2)                 w: twiddle factor
 *
 * a - b wraps at 16 bits; products are 1.31 fractions, sums have 40 bits; storing halves, rounds to nearest with ties
 * to even and saturates to 16 bits. Not the same: the time, which is that of this C, some ten times the original's.
 */
#ifdef __TWINPUCK__
#include "dsp.h"

#define MOST_STAGES 12

/* a sum of 1.31 products to memory, halved; sums of two never reach the 40 bits' end */
static fractional store_half(long long sum) {
  long long halved = sum >> 1;
  long word = (long)(halved >> 16);
  unsigned int rest = (unsigned int)(halved & 0xFFFF);
  if (rest > 0x8000u || (rest == 0x8000u && (word & 1))) word++;
  return (fractional)(word > 32767 ? 32767 : word < -32767 - 1 ? -32767 - 1 : word);
}

static long long product(int a, int b) { return 2 * (long long)((long)a * b); }

static void butterfly(fractcomplex *upper, fractcomplex *lower, const fractcomplex *w) {
  fractcomplex a = *upper, b = *lower;
  int real = (int)((unsigned int)a.real - (unsigned int)b.real);
  int imag = (int)((unsigned int)a.imag - (unsigned int)b.imag);
  lower->real = store_half(product(real, w->real) - product(imag, w->imag));
  lower->imag = store_half(product(real, w->imag) + product(imag, w->real));
  upper->real = store_half((long long)((long)a.real + b.real) * 65536);
  upper->imag = store_half((long long)((long)a.imag + b.imag) * 65536);
}

fractcomplex *FFTComplexIP(int log2N, fractcomplex *srcCV, fractcomplex *twidFactors, int factPage) {
  unsigned int n, groups, step, first, g;
  (void)factPage;
  if (log2N < 1 || log2N > MOST_STAGES) return srcCV;
  n = 1u << log2N;
  for (groups = n / 2, step = 1; groups > 0; groups /= 2, step *= 2)
    for (first = 0; first < n; first += 2 * groups)
      for (g = 0; g < groups; g++) butterfly(&srcCV[first + g], &srcCV[first + g + groups], &twidFactors[g * step]);
  return srcCV;
}

fractcomplex *BitReverseComplex(int log2N, fractcomplex *srcCV) {
  unsigned int i, j = 0, bit, n;
  if (log2N < 1 || log2N > MOST_STAGES) return srcCV;
  n = 1u << log2N;
  for (i = 1; i < n; i++) {
    /* j counts as i does, from the other end */
    for (bit = n >> 1; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (j > i) {
      fractcomplex point = srcCV[i];
      srcCV[i] = srcCV[j];
      srcCV[j] = point;
    }
  }
  return srcCV;
}

#endif
