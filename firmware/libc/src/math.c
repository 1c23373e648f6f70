/* SPDX-License-Identifier: MIT
 * Firmware libc: single-precision mathematics. What takes series and tables is the
 * runtime's (hal_dspic/runtime/math_functions.c). */
#include <math.h>

union bits { float f; unsigned long u; };

float tp_m_sinf(float x);
float tp_m_cosf(float x);
float tp_m_tanf(float x);
float tp_m_asinf(float x);
float tp_m_acosf(float x);
float tp_m_atanf(float x);
float tp_m_sinhf(float x);
float tp_m_coshf(float x);
float tp_m_tanhf(float x);
float tp_m_expf(float x);
float tp_m_logf(float x);
float tp_m_log10f(float x);
float tp_m_sqrtf(float x);
float tp_m_floorf(float x);
float tp_m_ceilf(float x);
float tp_m_atan2f(float x, float y);
float tp_m_powf(float x, float y);
float tp_m_fmodf(float x, float y);
float tp_m_ldexpf(float x, int e);

double sin(double x) { return tp_m_sinf(x); }
float sinf(float x) { return sin(x); }

double cos(double x) { return tp_m_cosf(x); }
float cosf(float x) { return cos(x); }

double tan(double x) { return tp_m_tanf(x); }
float tanf(float x) { return tan(x); }

double asin(double x) { return tp_m_asinf(x); }
float asinf(float x) { return asin(x); }

double acos(double x) { return tp_m_acosf(x); }
float acosf(float x) { return acos(x); }

double atan(double x) { return tp_m_atanf(x); }
float atanf(float x) { return atan(x); }

double sinh(double x) { return tp_m_sinhf(x); }
float sinhf(float x) { return sinh(x); }

double cosh(double x) { return tp_m_coshf(x); }
float coshf(float x) { return cosh(x); }

double tanh(double x) { return tp_m_tanhf(x); }
float tanhf(float x) { return tanh(x); }

double exp(double x) { return tp_m_expf(x); }
float expf(float x) { return exp(x); }

double log(double x) { return tp_m_logf(x); }
float logf(float x) { return log(x); }

double log10(double x) { return tp_m_log10f(x); }
float log10f(float x) { return log10(x); }

double sqrt(double x) { return tp_m_sqrtf(x); }
float sqrtf(float x) { return sqrt(x); }

double floor(double x) { return tp_m_floorf(x); }
float floorf(float x) { return floor(x); }

double ceil(double x) { return tp_m_ceilf(x); }
float ceilf(float x) { return ceil(x); }

double atan2(double x, double y) { return tp_m_atan2f(x, y); }
float atan2f(float x, float y) { return atan2(x, y); }

double pow(double x, double y) { return tp_m_powf(x, y); }
float powf(float x, float y) { return pow(x, y); }

double fmod(double x, double y) { return tp_m_fmodf(x, y); }
float fmodf(float x, float y) { return fmod(x, y); }

double fabs(double x)
{
  union bits b;
  b.f = x;
  b.u &= 0x7FFFFFFFUL;
  return b.f;
}
float fabsf(float x) { return fabs(x); }

double trunc(double x) { return x < 0 ? ceil(x) : floor(x); }
float truncf(float x) { return trunc(x); }
double round(double x)
{
  double whole = trunc(x);
  return fabs(x - whole) >= 0.5f ? whole + copysign(1, x) : whole;
}
float roundf(float x) { return round(x); }

/* the sum is rounded as it should be: to a whole number, halves to the even one */
double rint(double x)
{
  const float from = 8388608.0f;
  return fabs(x) < from ? copysign(fabs(x) + from - from, x) : x;
}
float rintf(float x) { return rint(x); }

double fmin(double x, double y) { return x < y || y != y ? x : y; }
double fmax(double x, double y) { return x > y || y != y ? x : y; }
float fminf(float x, float y) { return fmin(x, y); }
float fmaxf(float x, float y) { return fmax(x, y); }

double hypot(double x, double y)
{
  const float small = 0x1p-100f;
  double squares = x * x + y * y, by = 1;
  if (fabs(x) == HUGE_VAL || fabs(y) == HUGE_VAL) return HUGE_VAL;
  if (squares == HUGE_VAL) by = 0x1p-70f;
  else if (squares < small) by = 0x1p100f;
  else return sqrt(squares);
  x *= by, y *= by;
  return sqrt(x * x + y * y) / by;
}
float hypotf(float x, float y) { return hypot(x, y); }

double copysign(double x, double y)
{
  union bits a, b;
  a.f = x, b.f = y;
  a.u = (a.u & 0x7FFFFFFFUL) | (b.u & 0x80000000UL);
  return a.f;
}
float copysignf(float x, float y) { return copysign(x, y); }

double ldexp(double x, int e) { return tp_m_ldexpf(x, e); }
float ldexpf(float x, int e) { return ldexp(x, e); }

double frexp(double x, int *e)
{
  *e = 0;
  if (x == 0 || x != x || x - x != 0) return x;
  while (fabs(x) >= 1) x *= 0.5f, ++*e;
  while (fabs(x) < 0.5f) x *= 2, --*e;
  return x;
}
float frexpf(float x, int *e) { return frexp(x, e); }

double modf(double x, double *whole)
{
  *whole = trunc(x);
  return copysign(fabs(x) == HUGE_VAL ? 0 : x - *whole, x);
}
float modff(float x, float *whole)
{
  double all;
  x = modf(x, &all);
  *whole = all;
  return x;
}
