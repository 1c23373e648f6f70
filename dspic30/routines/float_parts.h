// SPDX-License-Identifier: MIT
// Parts of a float.
#pragma once
#include <cstdint>

#include "dspic30/routines/forms.h"

namespace dspic::float_parts {

using namespace forms;

constexpr int kFraction = 23, kBias = 127, kLargest = 254;  // exponent of the largest number
constexpr std::uint32_t kSign = 0x80000000u, kHidden = 0x800000u, kInfinity = 0x7F800000u;

inline std::uint32_t magnitude(std::uint32_t a) { return a & ~kSign; }
inline int exponent_of(std::uint32_t a) { return static_cast<int>(a >> kFraction & 0xFF); }
/// With a hidden bit.
inline bool is_normal(std::uint32_t a) { return static_cast<unsigned>(exponent_of(a) - 1) < kLargest; }
/// Infinite, or not a number.
inline bool is_beyond(std::uint32_t a) { return exponent_of(a) > kLargest; }
inline std::uint32_t fraction_of(std::uint32_t normal) { return (normal & (kHidden - 1)) | kHidden; }
/// 24 bits on top of 32.
inline std::uint32_t widened(std::uint32_t normal) { return normal << 8 | kSign; }

}  // namespace dspic::float_parts
