/* SPDX-License-Identifier: MIT
 * Expressions with the value the robot computes, derived by hand: 16-bit int, 32-bit long, signed char, double as
 * float. E: as a 32-bit number. F: a float, compared bit for bit with the nearest single-precision number.
 * Built by language_test.cpp at -O0 -O1 -O2 -Os; prints "ok <count>" or each line that fails. */
#include <stdio.h>

static int failures, count;

static void check(int line, long got, long expected)
{
  count++;
  if (got != expected) {
    failures++;
    printf("line %d: got %ld, expected %ld\n", line, got, expected);
  }
}

static void check_float(int line, float got, float expected)
{
  count++;
  if (!(got == expected)) {
    failures++;
    printf("line %d: got %e, expected %e\n", line, got, expected);
  }
}

#define E(expression, expected) check(__LINE__, (long)(expression), (long)(expected));
#define F(expression, expected) check_float(__LINE__, (expression), (expected));

volatile int i0 = 0, i1 = 1, i2 = 2, i7 = 7, i15 = 15, i16 = 16, i200 = 200, i300 = 300, i1000 = 1000, m1 = -1, m5 = -5, m7 = -7;
volatile int big = 32767, low = -32767 - 1;
volatile unsigned int u0 = 0, u1 = 1, u5 = 5, u10 = 10, u40000 = 40000u, umax = 65535u;
volatile char c100 = 100, c127 = 127, cm56 = (char)200, cm1 = -1;
volatile unsigned char b1 = 1, b200 = 200, b255 = 255;
volatile long l1 = 1, l3 = 3, l16 = 65536L, l100k = 100000L, lm70k = -70000L, lbig = 2147483647L, llow = -2147483647L - 1;
volatile unsigned long ul1 = 1, ul3g = 3000000000UL, ulmax = 4294967295UL;
volatile long long q1 = 1, q5g = 5000000000LL;
volatile float f0 = 0.0f, f1 = 1.0f, f3 = 3.0f, f15 = 1.5f, fm275 = -2.75f, f1e10 = 1e10f, f16m = 16777216.0f, f01 = 0.1f;
volatile double d1 = 1.0, d10 = 10.0;

struct two { int a; char b; };
struct three { char a; long b; };
struct mixed { char a; int b; char c; };
struct bits { unsigned a : 3; unsigned b : 5; unsigned c : 8; };
struct signed_bits { int a : 4; int b : 12; };
struct wide_bits { unsigned a : 12; unsigned b : 12; };
struct chars { char a, b, c; };
union word { int i; unsigned char b[2]; };
union twice { long l; unsigned int w[2]; };
enum colour { RED, GREEN = 40000 - 32768, BLUE };

static void sizes(void)
{
  E(sizeof(char), 1) E(sizeof(short), 2) E(sizeof(int), 2) E(sizeof(unsigned), 2) E(sizeof(long), 4)
  E(sizeof(long long), 8) E(sizeof(float), 4) E(sizeof(double), 4) E(sizeof(long double), 8) E(sizeof(enum colour), 2)
  E(sizeof(struct two), 4) E(sizeof(struct three), 6) E(sizeof(struct mixed), 6) E(sizeof(struct bits), 2)
  E(sizeof(struct signed_bits), 2) E(sizeof(struct wide_bits), 4) E(sizeof(struct chars), 3) E(sizeof(union word), 2)
  E(sizeof(1), 2) E(sizeof(1L), 4) E(sizeof(1.0), 4) E(sizeof(1.0f), 4) E(sizeof('a'), 2) E(sizeof(32768), 4)
  E(sizeof(0x8000), 2) E(sizeof(0x10000), 4) E(sizeof(65535u), 2) E(sizeof(c100 + c100), 2) E(sizeof(i1 + l1), 4)
  E(sizeof(i1 + u1), 2) E(sizeof(f1 + i1), 4) E(sizeof("abc"), 4) E(sizeof(int[10]), 20) E(sizeof(sizeof(int)), 2)
  E(sizeof(struct three[3]), 18) E((char *)&((struct three *)0)->b - (char *)0, 2) E(sizeof(b1 << i1), 2)
  E((&((int *)0)[5] - &((int *)0)[2]), 3)
}

static void integers(void)
{
  /* wrap-around of 16 bits */
  E(big + 1, -32768L) E(low - 1, 32767) E(i300 * i300, 24464) E(i200 * i200, -25536) E(-low, -32768L) E(umax + 1, 0)
  E(u0 - 1, 65535) E(u40000 + u40000, 14464) E(u40000 * 2, 14464) E(i1000 * i1000, 16960) E(big * 2, -2) E(big + big, -2)
  E(i300 * 300L, 90000) E(l1 * i300 * i300, 90000) E((long)i300 * i300, 90000) E((long)(i300 * i300), 24464)
  E(big - low, -1) E(low * m1, -32768L) E(i1000 * 33, -32536) E(u10 * 6554, 4)
  /* division truncates towards zero */
  E(m7 / i2, -3) E(m7 % i2, -1) E(i7 / -2, -3) E(i7 % -2, 1) E(low / m1, -32768L) E(low % m1, 0) E(u40000 / 3, 13333)
  E(u40000 % 7, 2) E(m7 / 2u, 32764) E(umax / u10, 6553) E(lm70k / i300, -233) E(lm70k % i300, -100) E(llow / m1, llow)
  E(llow % m1, 0) E(ul3g / 7, 428571428L) E(ul3g % 1000, 0) E(l100k / 7, 14285) E(i1000 / i300, 3) E(m5 / 2, -2) E(m5 % 3, -2)
  E(m5 / 8, 0) E(m7 / 4, -1) E(-i1000 / 10, -100) E(m1 / 2, 0)
  /* shifts */
  E(i1 << 15, -32768L) E(u1 << 15, 32768L) E(i1 << i15, -32768L) E(i1 << i16, 0) E(m1 >> 1, -1) E(low >> 15, -1) E(m5 >> 1, -3)
  E(umax >> 4, 4095) E(umax >> i16, 0) E(m1 >> i16, -1) E(l1 << 16, 65536L) E(l1 << 31, -2147483647L - 1) E(lm70k >> 4, -4375)
  E(ul3g >> 8, 11718750L) E(ul3g >> 31, 1) E((unsigned)m1 >> 12, 15) E(b200 << 8, -14336) E(b255 << 7, 32640) E(cm56 >> 2, -14)
  E((unsigned char)(b200 << 1), 144) E(1 << 4, 16) E(l100k << 3, 800000L) E(l100k >> i15, 3) E(i300 >> i2, 75) E(i300 << i2, 1200)
  E(i300 << 8, 11264) E(u5 << 14, 16384) E(ul1 << i16, 65536L)
  /* characters */
  E(cm56, -56) E(b200, 200) E(c127 + 1, 128) E((char)(c127 + 1), -128) E((char)300, 44) E((unsigned char)300, 44) E((unsigned char)m1, 255)
  E(cm1 == b255, 0) E((unsigned char)cm1 == b255, 1) E(c100 * c100, 10000) E(b255 * b255, -511) E(b200 + b200, 400) E((unsigned char)(b200 + b200), 144)
  E(~b1, -2) E((unsigned char)~b1, 254) E(-b200, -200) E(!b200, 0) E('\xff', -1) E('\377' < 0, 1) E((char)0x80 >> 7, -1) E(b255 >> 4, 15)
  /* comparison of mixed signs */
  E(m1 < u1, 0) E(m1 > u1, 1) E(m1 == umax, 1) E(-1 < 1u, 0) E(m1 < l1, 1) E(umax > m1, 0) E(umax > l1, 1) E((long)umax, 65535L)
  E(u40000 > i0, 1) E((int)u40000 < 0, 1) E(lm70k < u1, 1) E(lm70k < ul1, 0) E(b255 > m1, 1) E(cm1 < b1, 1) E(i0 - 1 < u0, 0)
  E(umax == -1, 1) E(umax == -1L, 0) E(ulmax == m1, 1) E(u40000 == 40000L, 1) E((int)u40000 == 40000L, 0)
  /* promotion and conversion */
  E((int)l100k, -31072) E((unsigned)l100k, 34464) E((int)lm70k, -4464) E((unsigned)lm70k, 61072) E((char)l100k, -96) E((long)m1, -1)
  E((unsigned long)m1 == 4294967295UL, 1) E((long)(unsigned)m1, 65535L) E((long)u40000, 40000L) E((int)ul3g, 24064) E((long)(unsigned char)cm56, 200)
  E(0xFFFF + 1, 0) E(0xFFFF, 65535L) E(65535 + 1, 65536L) E(32767 + 1, -32768L) E(32768, 32768L) E(-32768 < 0, 1) E(0x8000 > 0, 1) E(-0x8000 == 0x8000, 1)
  E(1000 * 1000, 16960) E(1000L * 1000, 1000000L) E(60 * 1000, -5536) E(60u * 1000, 60000L) E('a' * 1000, 31464)
  E(0b1010, 10) E(0b11111111, 255) E(010, 8) E(40000, 40000L) E(40000u + 40000u, 14464) E(RED, 0) E(GREEN, 7232) E(BLUE, 7233)
  /* long arithmetic */
  E(l100k * 1000, 100000000L) E(l100k * l100k, 1410065408L) E(lbig + 1, -2147483647L - 1) E(llow - 1, 2147483647L) E(-llow, llow) E(l16 * l16, 0)
  E(l100k - 100001L, -1) E(ulmax + 1, 0) E(ul3g * 2, 1705032704L) E(l100k & 0xFFFF, 34464) E(l100k | 1, 100001L) E(l100k ^ l100k, 0) E(~l100k, -100001L)
  E(lm70k & 0xFF, 144) E(ul3g > l100k, 1) E(lm70k > l100k, 0) E(l16 - 1 == 65535u, 1) E(l3 * m5, -15) E((l16 >> 16) + i1, 2) E(lbig % l16, 65535L)
  E((int)(q5g / 1000000), 5000) E((long)q5g, 705032704L) E((int)(q5g % 7), 2) E(q1 << 40 == 1099511627776LL, 1) E(q5g > ul3g, 1)
  /* bit operations */
  E(u40000 & 0xFF, 64) E(u40000 | 1, 40001L) E(~i0, -1) E(~u0, 65535L) E(i7 & ~i2, 5) E(i7 ^ m1, -8) E(-u1, 65535L) E(!i0, 1) E(!!u40000, 1)
  E(i7 && i0, 0) E(i7 || i0, 1) E(i1 ? m5 : u1, 65531L) E(i1 ? m5 : l1, -5) E((i1, i7), 7) E(i300 & 0xF0, 32) E(-i7 & 7, 1)
}

static void statements(void)
{
  unsigned char b = 250;
  char c = 120;
  int i = 32760, *p, t[4] = {1, 2, 3, 4};
  unsigned int u = 3;
  long l = 0;
  struct bits s = {0, 0, 0};
  struct signed_bits g;
  union word w;
  union twice v;
  struct two a = {300, 4}, copy;
  b += 10; E(b, 4)
  b -= 5; E(b, 255)
  b++; E(b, 0)
  c += 10; E(c, -126)
  c *= 2; E(c, 4)
  i += 10; E(i, -32766)
  i /= 2; E(i, -16383)
  i <<= 1; E(i, -32766)
  u -= 5; E(u, 65534L)
  u >>= 1; E(u, 32767)
  l += 70000L; E(l, 70000L)
  l -= u40000; E(l, 30000)
  l = i300 * i300; E(l, 24464)
  l = (long)i300 * i300; E(l, 90000L)
  l = u40000 + u40000; E(l, 14464)
  i = 70000L; E(i, 4464)
  c = 300; E(c, 44)
  s.a = 9; E(s.a, 1)
  s.b = 33; E(s.b, 1)
  s.c = 511; E(s.c, 255)
  s.a += 7; E(s.a, 0)
  E(s.b << 14, 16384) E(s.c << 8, -256)
  g.a = 9; E(g.a, -7)
  g.b = 2048; E(g.b, -2048)
  w.i = 0x1234; E(w.b[0], 0x34) E(w.b[1], 0x12)
  v.l = 0x12345678L; E(v.w[0], 0x5678) E(v.w[1], 0x1234)
  p = t + 1; E(p[1], 3) E(*p++, 2) E(p - t, 2) E(*--p, 2) E(&t[3] - p, 2)
  copy = a; E(copy.a, 300) E(copy.b, 4)
  for (i = 0, u = 0; i < 300; i++) u += 300; E(u, 24464)
  for (b = 0, i = 0; i < 300; i++) b++; E(b, 44)
  i = 5; i = i++ + 2; E(i == 7 || i == 6, 1)
  switch (u40000) { case 40000u: i = 1; break; default: i = 2; } E(i, 1)
  switch ((char)200) { case -56: i = 3; break; default: i = 4; } E(i, 3)
}

static void floats(void)
{
  F(f1 / f3, 0.333333343f) F(f01 + 0.2f, 0.300000012f) F(d1 / d10, 0.1f) F(f16m + 1, 16777216.0f) F(f15 * fm275, -4.125f) F(f15 - fm275, 4.25f)
  F(f1e10 + 1.0f, 1e10f) F(f1e10 * f1e10, 1e20f) F(fm275 / f15, -1.83333337f) F(i300 * f15, 450.0f) F(l100k * f15, 150000.0f) F(u40000 + f1, 40001.0f)
  F(-f15, -1.5f) F(i7 / i2, 3.0f) F(i7 / (float)i2, 3.5f) F(m7 / 2.0, -3.5f) F((float)lbig, 2147483648.0f) F((float)ulmax, 4294967296.0f) F((float)16777217L, 16777216.0f)
  F((float)m1, -1.0f) F((float)umax, 65535.0f) F(cm56 * f1, -56.0f) F(0.1 + 0.2, 0.3f) F(1e38 * f1, 1e38f) F(3.14159265358979 * f1, 3.14159274f) F(f01 * 10, 1.0f)
  E((int)fm275, -2) E((int)f15, 1) E((long)f1e10 == 2147483647L, 1) E((unsigned)(f1 * 40000.0f), 40000L) E((int)(f1 * 40000.0f), -25536)
  E((long)(f15 * 100000.0f), 150000L) E((unsigned char)(f15 * 100), 150) E((char)(f15 * 100), -106) E(f01 * 10 == f1, 1) E(f01 + 0.2f == 0.3f, 1) E(d1 / 3 * 3 == d1, 1)
  E(fm275 < 0, 1) E(f15 > i1, 1) E(f0 == -f0, 1) E(!f0, 1) E(f15 && f1, 1) E(f16m + 1 == f16m, 1) E((int)(f01 * 100), 10) E((f1 / f3) * 3 == 1.0f, 1)
}

int main(void)
{
  sizes();
  integers();
  statements();
  floats();
  if (!failures) printf("ok %d", count);
  return 0;
}
