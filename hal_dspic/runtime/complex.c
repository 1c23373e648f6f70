/* SPDX-License-Identifier: MIT
 * Runtime of the chip: products and quotients of complex numbers. Infinities and not-a-number as the parts give them;
 * the C standard's recovery of infinities (annex G) is not done. */
#define PRODUCT(name, real)                   \
  real _Complex name(real a, real b, real c, real d) \
  {                                           \
    real _Complex z;                          \
    __real__ z = a * c - b * d;               \
    __imag__ z = a * d + b * c;               \
    return z;                                 \
  }

/* by the larger part of the divisor, so that its square does not overflow */
#define QUOTIENT(name, real)                                                              \
  real _Complex name(real a, real b, real c, real d)                                      \
  {                                                                                       \
    real _Complex z;                                                                      \
    const int is_wide = (c < 0 ? -c : c) < (d < 0 ? -d : d);                              \
    const real ratio = is_wide ? c / d : d / c, by = is_wide ? c * ratio + d : c + d * ratio; \
    __real__ z = (is_wide ? a * ratio + b : a + b * ratio) / by;                          \
    __imag__ z = (is_wide ? b * ratio - a : b - a * ratio) / by;                          \
    return z;                                                                             \
  }

PRODUCT(__mulsc3, float)
PRODUCT(__muldc3, long double)
QUOTIENT(__divsc3, float)
QUOTIENT(__divdc3, long double)
