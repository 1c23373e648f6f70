// SPDX-License-Identifier: MIT
// Sine, cosine and logarithm that give the same bits on every PC. The C library picks variants by processor
// (with or without fused multiply-add), which may differ in the last bit; digests must not. Polynomials:
// fdlibm (Sun, 1993). Accuracy: within 1e-15 absolute for sine and cosine of angles up to 1e6 rad, 1e-15
// relative for the logarithm.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sim {

inline constexpr double kTwoPi = 6.283185307179586;  // rad

struct SinCos {
  double s = 0;
  double c = 1;
};

/// Sine and cosine of an angle, rad.
inline SinCos sin_cos(double angle_rad) {
  // subtract the nearest multiple of a quarter turn, in three parts so that nothing is lost
  constexpr double kPerQuarter = 6.36619772367581382433e-01;
  constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to a whole number
  const double shifted = angle_rad * kPerQuarter + kRound;
  const double quarters = shifted - kRound;
  std::int64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  double r = angle_rad - quarters * 1.57079632673412561417e+00;
  r -= quarters * 6.07710050630396597660e-11;
  r -= quarters * 2.02226624879595063154e-21;
  // both polynomials side by side
  using Pair = double __attribute__((vector_size(16)));
  const double z = r * r;
  const Pair zz = {z, z};
  Pair p = {1.58969099521155010221e-10, -1.13596475577881948265e-11};
  p = Pair{-2.50507602534068634195e-08, 2.08757232129817482790e-09} + zz * p;
  p = Pair{2.75573137070700676789e-06, -2.75573143513906633035e-07} + zz * p;
  p = Pair{-1.98412698298579493134e-04, 2.48015872894767294178e-05} + zz * p;
  p = Pair{8.33333333332248946124e-03, -1.38888888888741095749e-03} + zz * p;
  p = Pair{-1.66666666666666324348e-01, 4.16666666666666019037e-02} + zz * p;
  const Pair both = Pair{r, 1 - 0.5 * z} + Pair{r, z} * zz * p;
  const double s = both[0], c = both[1];
  switch (bits & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

/// Natural logarithm of a positive normal number.
inline double natural_log(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // [0.5, 1)
  if (m < 0.70710678118654752440) {
    m *= 2;
    --exponent;
  }
  const double f = m - 1;
  const double s = f / (2 + f);
  const double z = s * s;
  const double r =
      z * (6.666666666666735130e-01 +
           z * (3.999999999940941908e-01 +
                z * (2.857142874366239149e-01 +
                     z * (2.222219843214978396e-01 +
                          z * (1.818357216161805012e-01 +
                               z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  const double half = 0.5 * f * f;
  const double k = static_cast<double>(exponent);
  return k * 6.93147180369123816490e-01 + (f - (half - (s * (half + r) + k * 1.90821492927058770002e-10)));
}

}  // namespace sim
