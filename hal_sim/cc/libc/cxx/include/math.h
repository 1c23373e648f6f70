/* SPDX-License-Identifier: MIT
 * In C++ abs() and its like know every type, with or without std. */
#ifdef _GLIBCXX_INCLUDE_NEXT_C_HEADERS
#include_next <math.h>
#elif !defined(TP_CXX_MATH_H)
#define TP_CXX_MATH_H
#include <cmath>
using std::abs;
using std::isfinite;
using std::isinf;
using std::isnan;
using std::signbit;
#endif
