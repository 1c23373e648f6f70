/* SPDX-License-Identifier: MIT
 * Runtime of the chip: long double, 64 bits wide, and its conversions from and to float. */
#define BITS unsigned long long
#define FRACTION 52
#define EXPONENT 11
#define OF_ANY(operation) __##operation##df3
#define NAME(operation, operands) __##operation##df##operands
#define FROM(kind) __##kind##df
#define TO(kind, width) __##kind##df##width

static unsigned long long by(unsigned long a, unsigned long b) { return (unsigned long long)a * b; }

static unsigned long long product(unsigned long long a, unsigned long long b)
{
  const unsigned long a1 = (unsigned long)(a >> 32), a0 = (unsigned long)a, b1 = (unsigned long)(b >> 32),
                      b0 = (unsigned long)b;
  const unsigned long long low = by(a0, b0), left = by(a1, b0), right = by(a0, b1);
  const unsigned long long middle = (low >> 32) + (left & 0xFFFFFFFF) + (right & 0xFFFFFFFF);
  const unsigned long long high = by(a1, b1) + (left >> 32) + (right >> 32) + (middle >> 32);
  return high | (((unsigned long)middle | (unsigned long)low) != 0);
}
#include "float_format.h"

unsigned long long __subdf3(unsigned long long a, unsigned long long b) { return sum(a, b ^ SIGN); }

enum { kFloatFraction = 23, kFloatBias = 127, kFloatLargest = 255, kCut = FRACTION - kFloatFraction };

unsigned long long __extendsfdf2(unsigned long a)
{
  const unsigned long long sign = (unsigned long long)(a >> 31) << 63;
  unsigned long m = a & 0x7FFFFF;
  int e = (int)(a >> kFloatFraction) & kFloatLargest;
  if (e == kFloatLargest) return sign | INFINITE | (unsigned long long)m << kCut | (m ? QUIET : 0);
  if (!e) {
    if (!m) return sign;
    for (e = 1; !(m & 0x800000); e--) m <<= 1;
    m &= 0x7FFFFF;
  }
  return sign | (unsigned long long)(unsigned)(e + BIAS - kFloatBias) << FRACTION | (unsigned long long)m << kCut;
}

unsigned long __truncdfsf2(unsigned long long a)
{
  const unsigned long sign = (unsigned long)(a >> 63) << 31, infinite = (unsigned long)kFloatLargest << kFloatFraction;
  unsigned long long m;
  unsigned long bits;
  unsigned rest;
  int e = exponent(a) - BIAS + kFloatBias;
  if (magnitude(a) > INFINITE) return sign | infinite | 0x400000 | (unsigned long)(a >> kCut & 0x3FFFFF);
  if (e >= kFloatLargest) return sign | infinite;
  m = shifted_down(fraction(a), kCut - GUARD);
  if (e < 1) m = shifted_down(m, 1 - e), e = 1;
  rest = (unsigned)m & 7u;
  bits = (unsigned long)(m >> GUARD);
  if (rest > 4u || (rest == 4u && (bits & 1u))) bits++;
  return sign | (((unsigned long)(unsigned)(e - 1) << kFloatFraction) + bits);
}
