/* SPDX-License-Identifier: MIT
 * Runtime of the chip: 64-bit integers, where an instruction sequence would be too long. */
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

/* divided by 0: as the chip's 32-bit division, all ones and the dividend */
static u64 divided(u64 x, u64 by, u64 *rest)
{
  words a, q;
  u64 r = 0;
  int i;
  a.whole = x;
  q.whole = 0;
  if (a.half.high == 0 && (u32)(by >> 32) == 0 && by) {
    q.half.low = a.half.low / (u32)by;
    *rest = a.half.low % (u32)by;
    return q.whole;
  }
  for (i = 0; i < 64; i++) {
    r = r << 1 | (a.half.high >> 31);
    a.whole <<= 1;
    q.whole <<= 1;
    if (r >= by) r -= by, q.half.low |= 1;
  }
  *rest = r;
  return q.whole;
}

u64 __udivdi3(u64 a, u64 b)
{
  u64 rest;
  return divided(a, b, &rest);
}

u64 __umoddi3(u64 a, u64 b)
{
  u64 rest;
  divided(a, b, &rest);
  return rest;
}

static u64 size_of(long long a) { return a < 0 ? 0 - (u64)a : (u64)a; }

long long __divdi3(long long a, long long b)
{
  u64 rest;
  const u64 q = divided(size_of(a), size_of(b), &rest);
  return (long long)((a < 0) != (b < 0) ? 0 - q : q);
}

long long __moddi3(long long a, long long b)
{
  u64 rest;
  divided(size_of(a), size_of(b), &rest);
  return (long long)(a < 0 ? 0 - rest : rest);
}
