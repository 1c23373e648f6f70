/* SPDX-License-Identifier: MIT
 * Runtime of the chip: products that tell whether they overflow (__builtin_mul_overflow). */
typedef unsigned long u32;
typedef unsigned long long u64;

long __mulosi4(long a, long b, int *overflow)
{
  const long long product = (long long)a * b;
  *overflow = product != (long)product;
  return (long)product;
}

long long __mulodi4(long long a, long long b, int *overflow)
{
  const int is_negative = (a < 0) != (b < 0);
  const u64 x = a < 0 ? 0 - (u64)a : (u64)a, y = b < 0 ? 0 - (u64)b : (u64)b, product = x * y;
  const u64 most = ((u64)1 << 63) - !is_negative;
  *overflow = x && (y > most / x);
  return (long long)(is_negative ? 0 - product : product);
}
