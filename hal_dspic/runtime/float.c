/* SPDX-License-Identifier: MIT
 * Runtime of the chip: float, which double is as well. Sums, products and quotients of numbers with a hidden bit are in
 * float_arithmetic.s. */
#define BITS unsigned long
#define FRACTION 23
#define EXPONENT 8
#define OF_ANY(operation) __any_##operation##sf3
#define NAME(operation, operands) __##operation##sf##operands
#define FROM(kind) __##kind##sf
#define TO(kind, width) __##kind##sf##width

static unsigned long by(unsigned a, unsigned b) { return (unsigned long)a * b; }

static unsigned long product(unsigned long a, unsigned long b)
{
  const unsigned a1 = (unsigned)(a >> 16), a0 = (unsigned)a, b1 = (unsigned)(b >> 16), b0 = (unsigned)b;
  const unsigned long low = by(a0, b0), left = by(a1, b0), right = by(a0, b1);
  const unsigned long middle = (low >> 16) + (left & 0xFFFF) + (right & 0xFFFF);
  const unsigned long high = by(a1, b1) + (left >> 16) + (right >> 16) + (middle >> 16);
  return high | (((unsigned)middle | (unsigned)low) != 0);
}
#include "float_format.h"
