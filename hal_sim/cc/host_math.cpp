// SPDX-License-Identifier: MIT
// Mathematics of the firmware's libc, in single precision, exported by the host's executable as tp_m_*. The
// image charges the cycles (libc/src/math.c); here only the value is made.
#include <cmath>

#define TP_EXPORT extern "C" __attribute__((visibility("default"), used))

TP_EXPORT float tp_m_sinf(float x) { return std::sin(x); }
TP_EXPORT float tp_m_cosf(float x) { return std::cos(x); }
TP_EXPORT float tp_m_tanf(float x) { return std::tan(x); }
TP_EXPORT float tp_m_asinf(float x) { return std::asin(x); }
TP_EXPORT float tp_m_acosf(float x) { return std::acos(x); }
TP_EXPORT float tp_m_atanf(float x) { return std::atan(x); }
TP_EXPORT float tp_m_atan2f(float y, float x) { return std::atan2(y, x); }
TP_EXPORT float tp_m_sinhf(float x) { return std::sinh(x); }
TP_EXPORT float tp_m_coshf(float x) { return std::cosh(x); }
TP_EXPORT float tp_m_tanhf(float x) { return std::tanh(x); }
TP_EXPORT float tp_m_expf(float x) { return std::exp(x); }
TP_EXPORT float tp_m_logf(float x) { return std::log(x); }
TP_EXPORT float tp_m_log10f(float x) { return std::log10(x); }
TP_EXPORT float tp_m_powf(float x, float y) { return std::pow(x, y); }
TP_EXPORT float tp_m_sqrtf(float x) { return std::sqrt(x); }
TP_EXPORT float tp_m_floorf(float x) { return std::floor(x); }
TP_EXPORT float tp_m_ceilf(float x) { return std::ceil(x); }
TP_EXPORT float tp_m_fmodf(float x, float y) { return std::fmod(x, y); }
