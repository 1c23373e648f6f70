/* SPDX-License-Identifier: MIT
 * Microchip's signal-processing library, as far as programs for the robot use it. With XC16 the vendor's header is
 * used. Nothing here blocks for longer than its computation.
 */
#ifndef __TWINPUCK__
#include_next <dsp.h>
#else
#ifndef TWINPUCK_DSP_H
#define TWINPUCK_DSP_H

/** A fraction from -1 to 1 - 2^-15, times 2^15. */
typedef int fractional;

typedef struct {
  fractional real;
  fractional imag;
} fractcomplex;

/** A constant between -1 and 1 as a fraction, rounded. */
#define Q15(X) ((X) < 0.0 ? (int)(32768 * (X) - 0.5) : (int)(32767 * (X) + 0.5))

#define Float2Fract(X) Q15(X)
/** -1 to 1; positive fractions are divided by 32767, so that the highest gives 1. */
float Fract2Float(fractional aVal);

#ifndef PI
#define PI 3.14159265358979
#endif
#ifndef NULL
#define NULL ((void*)0)
#endif

/** `factPage` of twiddle factors that lie in data memory; any other number: in program memory (takes longer). */
#define COEFFS_IN_DATA 0xFF00
/* place of a constant in program memory: constants have one address here */
#undef __builtin_psvoffset
#undef __builtin_psvpage
#define __builtin_psvoffset(object) (object)
#define __builtin_psvpage(object) 0

/** The first 2^log2N / 2 factors exp(-2 pi i k / 2^log2N) (exp(+...) with conjFlag), each computed from the one
 *  before in single precision. */
fractcomplex *TwidFactorInit(int log2N, fractcomplex *twidFactors, int conjFlag);
/** Transform of 2^log2N points in place, divided by their number; every part of the input below 0.5, or sums wrap.
 *  The result is in bit-reversed order. log2N above 12 or below 1: nothing happens. */
fractcomplex *FFTComplexIP(int log2N, fractcomplex *srcCV, fractcomplex *twidFactors, int factPage);
/** Bit-reversed order to natural order. */
fractcomplex *BitReverseComplex(int log2N, fractcomplex *srcCV);
/** Both, into another array. */
fractcomplex *FFTComplex(int log2N, fractcomplex *dstCV, fractcomplex *srcCV, fractcomplex *twidFactors,
                         int factPage);
/** real * real + imag * imag of each element; `dstV` may be `srcV` itself. */
fractional *SquareMagnitudeCplx(int numElems, fractcomplex *srcV, fractional *dstV);
/** The highest element; of equal ones the last one's index. */
fractional VectorMax(int numElems, fractional *srcV, int *maxIndex);

#endif
#endif
