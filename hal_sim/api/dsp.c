/* SPDX-License-Identifier: MIT
 * The part of Microchip's signal-processing library that programs for the robot use. Arithmetic is the DSP engine's
 * (hal_sim/host/pins_dsp.h); the cycles are the published ones where there are any.
 * Source: the library's own tables of cycles and its manual, 16-bit Language Tools Libraries [vendor], restated.
 */
#include "dsp.h"

#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_dsp.h"
#include "math.h"

#define FIRST_KNOWN 5 /* log2 of the smallest transform whose cycles are published */
#define LAST_KNOWN 9
#define MOST_STAGES 12
#define BUTTERFLY_CYCLES 19 /* [derived: published cycles over butterflies, 18.6 to 20.8] */

/* cycles of FFTComplexIP() for 32 to 512 points, call and return included [vendor] */
static const long cycles_from_data[] = {1664, 3802, 8612, 19310, 42872};
static const long cycles_from_program[] = {1827, 4189, 9511, 21361, 47483};

/* a bad pointer is the program's own fault, so the program's own code meets it first */
static void touch(const fractcomplex *array, int count) {
  (void)*(const volatile int *)&array[0].real;
  (void)*(const volatile int *)&array[count - 1].imag;
}

fractcomplex *FFTComplexIP(int log2N, fractcomplex *srcCV, fractcomplex *twidFactors, int factPage) {
  long cycles;
  if (log2N < 1 || log2N > MOST_STAGES) return srcCV;
  touch(srcCV, 1 << log2N);
  touch(twidFactors, 1 << (log2N - 1));
  if (log2N < FIRST_KNOWN || log2N > LAST_KNOWN)
    cycles = (long)BUTTERFLY_CYCLES * log2N << (log2N - 1);
  else if (factPage == COEFFS_IN_DATA)
    cycles = cycles_from_data[log2N - FIRST_KNOWN];
  else
    cycles = cycles_from_program[log2N - FIRST_KNOWN];
  tp_dsp_fft(log2N, srcCV, twidFactors);
  tp_spend(cycles);
  return srcCV;
}

fractcomplex *BitReverseComplex(int log2N, fractcomplex *srcCV) {
  long points, swaps;
  if (log2N < 1 || log2N > MOST_STAGES) return srcCV;
  touch(srcCV, 1 << log2N);
  points = 1L << log2N;
  swaps = (points - (1L << (log2N + 1) / 2)) / 2;
  tp_dsp_bit_reverse(log2N, srcCV);
  tp_spend(25 + 5 * points + 5 * swaps); /* [derived: instructions of the loop; 1905 for 256 points] */
  return srcCV;
}

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
