/* SPDX-License-Identifier: MIT
 * Types of Microchip's DSP library. */
#ifndef TP_LIBC_DSP_H
#define TP_LIBC_DSP_H
typedef int fractional;
typedef struct {
  fractional real;
  fractional imag;
} fractcomplex;
#ifndef NULL
#define NULL ((void*)0)
#endif
#ifndef PI
#define PI 3.14159265358979323846
#endif
#define Q15(x) ((x) < 0.0 ? (int)(32768.0 * (x)-0.5) : (int)(32767.0 * (x) + 0.5))
#endif
