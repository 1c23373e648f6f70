/* SPDX-License-Identifier: MIT
 * Runtime of the chip: 64-bit integers, where an instruction sequence would be too long; division is in
 * long_long_division.s. */
typedef unsigned long u32;
typedef unsigned long long u64;
typedef union {
  u64 whole;
  struct {
    u32 low, high;
  } half;
} words;

static u32 upper_product(u32 a, u32 b)
{
  const unsigned a1 = (unsigned)(a >> 16), a0 = (unsigned)a, b1 = (unsigned)(b >> 16), b0 = (unsigned)b;
  const u32 low = (u32)a0 * b0, left = (u32)a1 * b0, right = (u32)a0 * b1;
  const u32 middle = (low >> 16) + (left & 0xFFFF) + (right & 0xFFFF);
  return (u32)a1 * b1 + (left >> 16) + (right >> 16) + (middle >> 16);
}

u64 __muldi3(u64 x, u64 y)
{
  words a, b, r;
  a.whole = x, b.whole = y;
  r.half.low = a.half.low * b.half.low;
  r.half.high = upper_product(a.half.low, b.half.low) + a.half.low * b.half.high + a.half.high * b.half.low;
  return r.whole;
}

/* n is 0 to 63 */
u64 __ashldi3(u64 x, int n)
{
  words a;
  a.whole = x;
  if (n >= 32) {
    a.half.high = a.half.low << (n - 32);
    a.half.low = 0;
  } else if (n) {
    a.half.high = a.half.high << n | a.half.low >> (32 - n);
    a.half.low <<= n;
  }
  return a.whole;
}

u64 __lshrdi3(u64 x, int n)
{
  words a;
  a.whole = x;
  if (n >= 32) {
    a.half.low = a.half.high >> (n - 32);
    a.half.high = 0;
  } else if (n) {
    a.half.low = a.half.low >> n | a.half.high << (32 - n);
    a.half.high >>= n;
  }
  return a.whole;
}

long long __ashrdi3(long long x, int n)
{
  words a;
  a.whole = (u64)x;
  if (n >= 32) {
    a.half.low = (u32)((long)a.half.high >> (n - 32));
    a.half.high = (u32)((long)a.half.high >> 31);
  } else if (n) {
    a.half.low = a.half.low >> n | a.half.high << (32 - n);
    a.half.high = (u32)((long)a.half.high >> n);
  }
  return (long long)a.whole;
}
