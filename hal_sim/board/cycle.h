// SPDX-License-Identifier: MIT
// Time on the board: instruction cycles of one robot's clock since its power-up.
#pragma once
#include <cstdint>

namespace board {

using Cycle = std::int64_t;

/// A horizon that never comes.
inline constexpr Cycle kNever = INT64_MAX / 4;

}  // namespace board
