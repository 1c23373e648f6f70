/* SPDX-License-Identifier: MIT
 * The transforms of Microchip's signal-processing library; the rest is firmware/library/dsp_vectors.c. Arithmetic is the DSP engine's
 * (hal_sim/host/pins_dsp.h); the cycles are the published ones where there are any.
 * Source: the library's own tables of cycles and its manual, 16-bit Language Tools Libraries [vendor], restated.
 */
#include "dsp.h"

#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_dsp.h"

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
