// SPDX-License-Identifier: MIT
// Parts of a float in W1:W0 and W3:W2.
#pragma once
#include <cstdint>
#include <utility>

#include "dspic30/core/known_routine.h"

namespace dspic::float_parts {

constexpr int kFraction = 23, kBias = 127, kLargest = 254;  // exponent of the largest number
constexpr std::uint32_t kSign = 0x80000000u, kHidden = 0x800000u, kInfinity = 0x7F800000u,
                        kQuiet = 0x7FC00000u;

inline std::uint32_t first(std::uint64_t w) { return static_cast<std::uint32_t>(w); }
inline std::uint32_t second(std::uint64_t w) { return static_cast<std::uint32_t>(w >> 32); }
inline std::uint32_t magnitude(std::uint32_t a) { return a & ~kSign; }
inline int exponent_of(std::uint32_t a) { return static_cast<int>(a >> kFraction & 0xFF); }
/// With a hidden bit.
inline bool is_normal(std::uint32_t a) { return static_cast<unsigned>(exponent_of(a) - 1) < kLargest; }
inline std::uint32_t fraction_of(std::uint32_t normal) { return (normal & (kHidden - 1)) | kHidden; }
/// 24 bits on top of 32.
inline std::uint32_t widened(std::uint32_t normal) { return normal << 8 | kSign; }
/// In W1:W0; W3:W2 as it was.
inline KnownAnswer returned(std::uint64_t w, std::uint32_t result, int cycles) {
  return {(w & 0xFFFFFFFF00000000u) | result, cycles};
}

}  // namespace dspic::float_parts
