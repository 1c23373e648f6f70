/* SPDX-License-Identifier: MIT
 * The part of Microchip's signal-processing library that works on tables and vectors, in C; transforms are each HAL's.
 * With XC16 the vendor's library is linked instead of this.
 * Source: the library's manual, 16-bit Language Tools Libraries [vendor], restated.
 */
#ifdef __TWINPUCK__
#include "dsp.h"

#include "math.h"

#define MOST_STAGES 12

fractcomplex *FFTComplex(int log2N, fractcomplex *dstCV, fractcomplex *srcCV, fractcomplex *twidFactors, int factPage) {
  int i;
  if (log2N < 1 || log2N > MOST_STAGES) return dstCV;
  for (i = 0; i < 1 << log2N; i++) dstCV[i] = srcCV[i];
  FFTComplexIP(log2N, dstCV, twidFactors, factPage);
  return BitReverseComplex(log2N, dstCV);
}

/* each factor from the one before, in single precision: errors grow along the table, as in the original */
fractcomplex *TwidFactorInit(int log2N, fractcomplex *twidFactors, int conjFlag) {
  int count, i;
  float step_real, step_imag, real, imag;
  if (log2N < 1 || log2N > MOST_STAGES) return twidFactors;
  count = 1 << (log2N - 1);
  step_real = cosf((float)PI / count);
  step_imag = sinf((float)PI / count);
  if (!conjFlag) step_imag = -step_imag;
  twidFactors[0].real = Q15(1.0);
  twidFactors[0].imag = 0;
  real = step_real;
  imag = step_imag;
  for (i = 1; i < count; i++) {
    float next = real * step_real - imag * step_imag;
    twidFactors[i].real = Q15(real);
    twidFactors[i].imag = Q15(imag);
    imag = real * step_imag + imag * step_real;
    real = next;
  }
  return twidFactors;
}

fractional *SquareMagnitudeCplx(int numElems, fractcomplex *srcV, fractional *dstV) {
  int i;
  for (i = 0; i < numElems; i++) {
    /* 1.31 sum, stored rounded (ties to even) and saturated */
    long real = srcV[i].real, imag = srcV[i].imag;
    unsigned long sum = (unsigned long)(real * real) + (unsigned long)(imag * imag); /* below 2^31 + 1: 2.30 */
    unsigned long word = sum >> 15, rest = sum & 0x7FFF;
    if (rest > 0x4000 || (rest == 0x4000 && (word & 1))) word++;
    dstV[i] = word > 32767 ? 32767 : (fractional)word;
  }
  return dstV;
}

fractional VectorMax(int numElems, fractional *srcV, int *maxIndex) {
  fractional highest = srcV[0];
  int i;
  *maxIndex = 0;
  for (i = 1; i < numElems; i++)
    if (srcV[i] >= highest) { /* of equal ones the last */
      highest = srcV[i];
      *maxIndex = i;
    }
  return highest;
}

float Fract2Float(fractional aVal) { return aVal < 0 ? aVal / 32768.0f : aVal / 32767.0f; }

#endif
