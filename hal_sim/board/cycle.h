// SPDX-License-Identifier: MIT
// Time on the board: instruction cycles of one robot's clock since its power-up.
#pragma once
#include <cstdint>

namespace board {

using Cycle = std::int64_t;

/// Instruction cycles a second, nominally: 7.3728 MHz crystal, PLL x 8, four clocks an instruction.
inline constexpr Cycle kFcyHz = 14'745'600;  // [DS70143 table 19-1; lib: motor_led/e_epuck_ports.h]

/// A horizon that never comes: after 155 years, as the chip's.
inline constexpr Cycle kNever = INT64_MAX >> 7;

/// a / b of positive cycles or counts that are small nearly always: a short division takes half the time.
inline std::int64_t quotient(std::int64_t a, std::int64_t b) {
  if ((static_cast<std::uint64_t>(a) | static_cast<std::uint64_t>(b)) >> 32) return a / b;
  return static_cast<std::uint32_t>(a) / static_cast<std::uint32_t>(b);
}

}  // namespace board
