/* SPDX-License-Identifier: MIT
 * Firmware libc: single-precision mathematics under both names; double is float here. */
#ifndef TP_LIBC_MATH_H
#define TP_LIBC_MATH_H
#define M_E 2.7182818284590452354
#define M_LOG2E 1.4426950408889634074
#define M_LN2 0.69314718055994530942
#define M_LN10 2.30258509299404568402
#define M_PI 3.14159265358979323846
#define M_PI_2 1.57079632679489661923
#define M_PI_4 0.78539816339744830962
#define M_1_PI 0.31830988618379067154
#define M_2_PI 0.63661977236758134308
#define M_SQRT2 1.41421356237309504880
#ifndef PI
#define PI 3.14159265358979323846
#endif
#define HUGE_VAL (__builtin_huge_valf())
#define INFINITY (__builtin_inff())
#define NAN (__builtin_nanf(""))
#define isnan(x) ((x) != (x))
#define isinf(x) ((x) == HUGE_VAL || (x) == -HUGE_VAL)
#define signbit(x) __builtin_signbitf(x)
double sin(double __x);
float sinf(float __x);
double cos(double __x);
float cosf(float __x);
double tan(double __x);
float tanf(float __x);
double asin(double __x);
float asinf(float __x);
double acos(double __x);
float acosf(float __x);
double atan(double __x);
float atanf(float __x);
double sinh(double __x);
float sinhf(float __x);
double cosh(double __x);
float coshf(float __x);
double tanh(double __x);
float tanhf(float __x);
double exp(double __x);
float expf(float __x);
double log(double __x);
float logf(float __x);
double log10(double __x);
float log10f(float __x);
double sqrt(double __x);
float sqrtf(float __x);
double fabs(double __x);
float fabsf(float __x);
double floor(double __x);
float floorf(float __x);
double ceil(double __x);
float ceilf(float __x);
double trunc(double __x);
float truncf(float __x);
double round(double __x);
float roundf(float __x);
double rint(double __x);
float rintf(float __x);
double atan2(double __x, double __y);
float atan2f(float __x, float __y);
double pow(double __x, double __y);
float powf(float __x, float __y);
double fmod(double __x, double __y);
float fmodf(float __x, float __y);
double fmin(double __x, double __y);
float fminf(float __x, float __y);
double fmax(double __x, double __y);
float fmaxf(float __x, float __y);
double hypot(double __x, double __y);
float hypotf(float __x, float __y);
double copysign(double __x, double __y);
float copysignf(float __x, float __y);
double ldexp(double __x, int __e);
float ldexpf(float __x, int __e);
double frexp(double __x, int* __e);
float frexpf(float __x, int* __e);
double modf(double __x, double* __whole);
float modff(float __x, float* __whole);
#endif
