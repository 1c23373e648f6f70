// SPDX-License-Identifier: MIT
// Time on the board: instruction cycles of one robot's clock since its power-up.
#pragma once
#include <cstdint>

namespace board {

using Cycle = std::int64_t;

/// Instruction cycles a second, nominally: 7.3728 MHz crystal, PLL x 8, four clocks an instruction.
inline constexpr Cycle kFcyHz = 14'745'600;  // [DS70143 table 19-1; lib: motor_led/e_epuck_ports.h]

/// A horizon that never comes.
inline constexpr Cycle kNever = INT64_MAX / 4;

}  // namespace board
