/* SPDX-License-Identifier: MIT
 * Runtime of the chip: the functions of libc/src/math.c that a PC's own library computes there. Single precision: an
 * argument is reduced to a short interval, where a polynomial serves (coefficients: S. Moshier's Cephes, single precision,
 * facts of approximation theory). Errors are a few units in the last place; with an exponent that is not whole, pow() has
 * up to some forty near the ends of its range.
 */
#include <math.h>

union bits {
  float f;
  unsigned long u;
};

static const float kPi = 3.14159265358979f, kHalfPi = 1.57079632679490f;
enum { kExponentBias = 127, kFractionBits = 23, kWholeFrom = 23 };
#define kHidden 0x800000ul
#define kSign 0x80000000ul
#define kMagnitude 0x7FFFFFFFul
#define kInfinite 0x7F800000ul

static float number(unsigned long u)
{
  union bits b;
  b.u = u;
  return b.f;
}
static unsigned long bits_of(float f)
{
  union bits b;
  b.f = f;
  return b.u;
}
static int exponent_of(float x) { return (int)(bits_of(x) >> kFractionBits & 0xFF) - kExponentBias; }

/* --- whole numbers */

float tp_m_floorf(float x)
{
  const int e = exponent_of(x);
  unsigned long u = bits_of(x), below;
  if (e >= kWholeFrom || x == 0) return x;
  if (e < 0) return x < 0 ? -1 : 0;
  below = ((1ul << kFractionBits) - 1) >> e;
  if ((u & below) == 0) return x;
  if (x < 0) u += below; /* away from zero: a carry counts the exponent up, as it should */
  return number(u & ~below);
}

float tp_m_ceilf(float x) { return -tp_m_floorf(-x); }

/* fraction with its leading bit at the hidden bit's place, whose exponent goes to *e */
static unsigned long normal(unsigned long u, int *e)
{
  unsigned long m = u & (kHidden - 1);
  *e = (int)(u >> kFractionBits);
  if (*e) return m | kHidden;
  for (*e = 1; !(m & kHidden); --*e) m <<= 1;
  return m;
}

/* exact: the fractions are divided as whole numbers, bit by bit */
float tp_m_fmodf(float x, float y)
{
  const unsigned long u = bits_of(x) & kMagnitude, by = bits_of(y) & kMagnitude;
  unsigned long rest, m;
  int e, last;
  if (u >= kInfinite || by > kInfinite || by == 0) return NAN;
  if (u < by) return x;
  rest = normal(u, &e), m = normal(by, &last);
  for (; e > last; e--) {
    if (rest >= m) rest -= m;
    rest <<= 1;
  }
  if (rest >= m) rest -= m;
  if (rest == 0) return number(bits_of(x) & kSign);
  for (; !(rest & kHidden); e--) rest <<= 1;
  rest = e > 0 ? (rest & (kHidden - 1)) | (unsigned long)(unsigned)e << kFractionBits : rest >> (1 - e);
  return number((bits_of(x) & kSign) | rest);
}

/* --- powers of two */

/* x * 2^e; what is left of whole steps first, so that a small result is rounded once */
float tp_m_ldexpf(float x, int e)
{
  enum { kUp = 127, kDown = 126, kMost = 300 }; /* beyond it all is infinite, or 0 */
  if (e > kMost) e = kMost;
  if (e < -kMost) e = -kMost;
  x *= number((unsigned long)(unsigned)((e < 0 ? -(-e % kDown) : e % kUp) + kExponentBias) << kFractionBits);
  for (e = e < 0 ? -(-e / kDown) : e / kUp; e > 0; e--) x *= number((unsigned long)(kUp + kExponentBias) << kFractionBits);
  for (; e < 0; e++) x *= number((unsigned long)(kExponentBias - kDown) << kFractionBits);
  return x;
}

/* --- roots: two bits of the argument give one of the root */

float tp_m_sqrtf(float x)
{
  unsigned long m, root = 0, rest = 0;
  int e, i;
  if (x != x || x == 0 || x == (float)INFINITY) return x;
  if (x < 0) return NAN;
  e = exponent_of(x);
  m = (bits_of(x) & 0x7FFFFFul) | 0x800000ul;
  if (e == -kExponentBias) {
    m &= 0x7FFFFFul;
    for (e++; !(m & 0x800000ul); e--) m <<= 1;
  }
  if (e & 1) m <<= 1, e--;
  m <<= 7; /* its two leading bits on top */
  for (i = 0; i < 25; i++) {
    rest = rest << 2 | m >> 30;
    m <<= 2;
    root <<= 1;
    if (rest >= (root << 1 | 1)) rest -= root << 1 | 1, root |= 1;
  }
  root = (root >> 1) + (root & 1); /* one bit more was made for rounding */
  return number(((unsigned long)(unsigned)(e / 2 + kExponentBias - 1) << kFractionBits) + root);
}

/* --- angles */

/* 2/pi: 32 zeros, then its bits; sixteen a word */
static const unsigned kTwoOverPi[] = {0, 0, 0xA2F9, 0x836E, 0x4E44, 0x1529, 0xFC27, 0x57D1, 0xF534, 0xDDC0,
                                      0xDB62, 0x9599, 0x3C43, 0x9041, 0xFE51};

/* x less the nearest multiple of pi/2, of which the two lowest bits go to *quarter. Of x * 2/pi only what is below 4 is made:
 * 96 bits from there on, of which a float never cancels more than 32 (Payne and Hanek). */
static float reduced(float x, unsigned *quarter)
{
  enum { kZeros = 32, kWords = 6 };
  const unsigned long u = bits_of(x), m = (u & (kHidden - 1)) | kHidden;
  const int from = (int)(u >> kFractionBits & 0xFF) - kExponentBias - kFractionBits + kZeros - 2;
  const unsigned *bits = kTwoOverPi + (from >> 4);
  unsigned product[kWords];
  unsigned long carry = 0, high, low;
  int i, e = kExponentBias - 1;
  *quarter = 0;
  if ((u & kMagnitude) < 0x3F490FDBul) return x; /* pi/4 */
  for (i = kWords - 1; i >= 0; i--) {
    const unsigned word = (unsigned)(((unsigned long)bits[i] << 16 | bits[i + 1]) << (from & 15) >> 16);
    const unsigned long by_low = (unsigned long)(unsigned)m * word, sum = (carry & 0xFFFF) + (by_low & 0xFFFF);
    product[i] = (unsigned)sum;
    carry = (carry >> 16) + (by_low >> 16) + (sum >> 16) + (unsigned long)(unsigned)(m >> 16) * word;
  }
  *quarter = product[0] >> 14;
  high = ((unsigned long)product[0] << 16 | product[1]) << 2 | product[2] >> 14;
  low = ((unsigned long)product[2] << 16 | product[3]) << 2 | product[4] >> 14;
  x = 1.57079632679490f;
  if (high & kSign) high = ~high, low = ~low, ++*quarter, x = -x;
  for (; !(high & kSign); e--) high = high << 1 | low >> 31, low <<= 1;
  if (u & kSign) *quarter = 0 - *quarter, x = -x;
  return x * number(((unsigned long)(unsigned)(e - 1) << kFractionBits) + (high >> 8) + (high >> 7 & 1));
}

static float sine_near(float x)
{
  const float z = x * x;
  return x + x * z * (-1.6666654611e-1f + z * (8.3321608736e-3f - z * 1.9515295891e-4f));
}
static float cosine_near(float x)
{
  const float z = x * x;
  return 1 - 0.5f * z + z * z * (4.166664568298827e-2f + z * (-1.388731625493765e-3f + z * 2.443315711809948e-5f));
}

static float wave(float x, unsigned ahead)
{
  unsigned quarter;
  float r, v;
  if (x - x != 0) return NAN;
  if (x == 0 && !ahead) return x; /* with its sign */
  r = reduced(x, &quarter);
  quarter += ahead;
  v = quarter & 1 ? cosine_near(r) : sine_near(r);
  return quarter & 2 ? -v : v;
}

float tp_m_sinf(float x) { return wave(x, 0); }
float tp_m_cosf(float x) { return wave(x, 1); }
float tp_m_tanf(float x) { return wave(x, 0) / wave(x, 1); }

float tp_m_atanf(float x)
{
  const float a = x < 0 ? -x : x;
  float base = 0, r = a, z;
  if (x == 0) return x; /* with its sign */
  if (a > 2.414213562373095f) /* tan(3 pi / 8) */
    base = kHalfPi, r = -1 / a;
  else if (a > 0.4142135623730950f) /* tan(pi / 8) */
    base = kPi / 4, r = (a - 1) / (a + 1);
  z = r * r;
  r = base + (r + r * z * (-3.33329491539e-1f + z * (1.99777106478e-1f + z * (-1.38776856032e-1f + z * 8.05374449538e-2f))));
  return x < 0 ? -r : r;
}

float tp_m_atan2f(float y, float x)
{
  if (x == 0 && y == 0) return bits_of(x) >> 31 ? (bits_of(y) >> 31 ? -kPi : kPi) : y;
  if ((bits_of(x) & kMagnitude) == kInfinite && (bits_of(y) & kMagnitude) == kInfinite)
    x = copysignf(1, x), y = copysignf(1, y);
  if (x == 0) return y > 0 ? kHalfPi : -kHalfPi;
  if (x > 0) return tp_m_atanf(y / x);
  return tp_m_atanf(y / x) + (y < 0 || bits_of(y) >> 31 ? -kPi : kPi);
}

float tp_m_asinf(float x)
{
  if (x > 1 || x < -1) return NAN;
  return tp_m_atan2f(x, tp_m_sqrtf((1 - x) * (1 + x)));
}
float tp_m_acosf(float x)
{
  if (x > 1 || x < -1) return NAN;
  return tp_m_atan2f(tp_m_sqrtf((1 - x) * (1 + x)), x);
}

/* --- exponentials */

float tp_m_expf(float x)
{
  float n, r;
  if (x != x) return x;
  if (x > 88.72283905206835f) return (float)INFINITY;
  if (x < -103.97208f) return 0;
  n = tp_m_floorf(x * 1.44269504088896f + 0.5f);
  r = (x - n * 0.693359375f) + n * 2.12194440e-4f;
  r = 1 + r + r * r * (5.0000001201e-1f + r * (1.6666665459e-1f + r * (4.1665795894e-2f + r * (8.3334519073e-3f +
      r * (1.3981999507e-3f + r * 1.9875691500e-4f)))));
  return tp_m_ldexpf(r, (int)n);
}

float tp_m_logf(float x)
{
  int e = 0;
  float m, z, r;
  if (x != x || x == (float)INFINITY) return x;
  if (x < 0) return NAN;
  if (x == 0) return -(float)INFINITY;
  m = frexpf(x, &e);
  if (m < 0.707106781186547f) m = m + m, e--;
  m -= 1;
  z = m * m;
  r = m * z * (3.3333331174e-1f + m * (-2.4999993993e-1f + m * (2.0000714765e-1f + m * (-1.6668057665e-1f + m * (1.4249322787e-1f +
      m * (-1.2420140846e-1f + m * (1.1676998740e-1f + m * (-1.1514610310e-1f + m * 7.0376836292e-2f))))))));
  r += (float)e * -2.12194440e-4f - 0.5f * z;
  return m + r + (float)e * 0.693359375f;
}

float tp_m_log10f(float x) { return tp_m_logf(x) * 0.434294481903252f; }

/* half of e^x, also where e^x itself is infinite */
static float half_exp(float x)
{
  const float root = x > 88 ? tp_m_expf(0.5f * x) : 1;
  return x > 88 ? 0.5f * root * root : 0.5f * tp_m_expf(x);
}

float tp_m_sinhf(float x)
{
  const float up = half_exp(x < 0 ? -x : x), v = up - 0.25f / up;
  if (x < 0.5f && x > -0.5f) return x + x * x * x * (1.6666667e-1f + x * x * (8.3333333e-3f + x * x * 1.98412698e-4f));
  return x < 0 ? -v : v;
}
float tp_m_coshf(float x)
{
  const float up = half_exp(x < 0 ? -x : x);
  return up + 0.25f / up;
}
float tp_m_tanhf(float x)
{
  if (x > 9) return 1;
  if (x < -9) return -1;
  return tp_m_sinhf(x) / tp_m_coshf(x);
}

/* a whole exponent by multiplication, which is exact where the result is */
static float whole_power(float x, unsigned n)
{
  float v = 1;
  for (; n; n >>= 1, x *= x)
    if (n & 1) v *= x;
  return v;
}

float tp_m_powf(float x, float y)
{
  const float whole = tp_m_floorf(y), a = x < 0 ? -x : x;
  float v;
  if (y == 0 || x == 1) return 1;
  if (whole == y && y > -1024 && y < 1024) {
    if (y > 0) return whole_power(x, (unsigned)(int)y);
    v = whole_power(x, 0u - (unsigned)(int)y);
    /* where it is infinite, a part of 1 / v may not be 0 */
    return v - v == 0 ? 1 / v : whole_power(1 / x, 0u - (unsigned)(int)y);
  }
  if (x != x || y != y || (x < 0 && whole != y && a != (float)INFINITY)) return NAN;
  if (a == 0) v = y < 0 ? (float)INFINITY : 0;
  else if (a == 1) v = 1;
  else v = tp_m_expf(y * tp_m_logf(a));
  return bits_of(x) & kSign && y - y == 0 && tp_m_fmodf(y, 2) != 0 && whole == y ? -v : v;
}
