/* SPDX-License-Identifier: MIT
 * Types of Microchip's signal-processing library, as far as the e-puck's library needs them. With XC16 the
 * vendor's header is used.
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

#ifndef PI
#define PI 3.14159265358979
#endif

#endif
#endif
