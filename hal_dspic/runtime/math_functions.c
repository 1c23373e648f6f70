/* SPDX-License-Identifier: MIT
 * Runtime of the chip: the functions of libc/src/math.c that a PC's own library computes there. Single precision: an
 * argument is reduced to a short interval, where a polynomial serves (coefficients: S. Moshier's Cephes, single precision,
 * facts of approximation theory). Errors are a few units in the last place.
 */
#include <math.h>

union bits {
  float f;
  unsigned long u;
};

static const float kPi = 3.14159265358979f, kHalfPi = 1.57079632679490f;
enum { kExponentBias = 127, kFractionBits = 23, kWholeFrom = 23 };

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

/* exact: the fractions are divided as whole numbers, bit by bit */
float tp_m_fmodf(float x, float y)
{
  float rest = x < 0 ? -x : x;
  const float by = y < 0 ? -y : y;
  if (x != x || y != y || by == 0 || rest == (float)INFINITY) return NAN;
  if (by == (float)INFINITY) return x;
  while (rest >= by) {
    const int apart = exponent_of(rest) - exponent_of(by);
    float scaled = by;
    if (apart > 0) {
      scaled = number(bits_of(by) + ((unsigned long)(unsigned)apart << kFractionBits));
      if (scaled > rest) scaled = number(bits_of(scaled) - (1ul << kFractionBits));
    }
    rest -= scaled;
  }
  return x < 0 ? -rest : rest;
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

/* x less its multiple of pi/2, which is in three parts so that the difference stays exact */
static float reduced(float x, unsigned *quarter)
{
  const float n = tp_m_floorf(x * 0.636619772367581f + 0.5f);
  *quarter = (unsigned)(int)(n - 65536.0f * tp_m_floorf(n * (1 / 65536.0f)) - 32768.0f) & 3u;
  return ((x - n * 1.5703125f) - n * 4.83751296997e-4f) - n * 7.5497899549e-8f;
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

static float scaled(float x, int e)
{
  for (; e > 127; e -= 127) x *= number((unsigned long)(127 + kExponentBias) << kFractionBits);
  for (; e < -126; e += 126) x *= number((unsigned long)(kExponentBias - 126) << kFractionBits);
  return x * number((unsigned long)(unsigned)(e + kExponentBias) << kFractionBits);
}

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
  return scaled(r, (int)n);
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

float tp_m_sinhf(float x)
{
  const float up = tp_m_expf(x < 0 ? -x : x), v = 0.5f * (up - 1 / up);
  if (x < 0.5f && x > -0.5f) return x + x * x * x * (1.6666667e-1f + x * x * (8.3333333e-3f + x * x * 1.98412698e-4f));
  return x < 0 ? -v : v;
}
float tp_m_coshf(float x)
{
  const float up = tp_m_expf(x < 0 ? -x : x);
  return 0.5f * (up + 1 / up);
}
float tp_m_tanhf(float x)
{
  if (x > 9) return 1;
  if (x < -9) return -1;
  return tp_m_sinhf(x) / tp_m_coshf(x);
}

/* a whole exponent by multiplication, which is exact where the result is */
static float whole_power(float x, long n)
{
  float v = 1;
  unsigned long left = n < 0 ? 0 - (unsigned long)n : (unsigned long)n;
  for (; left; left >>= 1, x *= x)
    if (left & 1) v *= x;
  return n < 0 ? 1 / v : v;
}

float tp_m_powf(float x, float y)
{
  const float whole = tp_m_floorf(y);
  if (y == 0 || x == 1) return 1;
  if (whole == y && y > -1024 && y < 1024) return whole_power(x, (long)y);
  if (x == 0) return y < 0 ? (float)INFINITY : 0;
  if (x < 0 && whole != y) return NAN;
  const float magnitude = tp_m_expf(y * tp_m_logf(x < 0 ? -x : x));
  return x < 0 && tp_m_fmodf(y, 2) != 0 ? -magnitude : magnitude;
}
