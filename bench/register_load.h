// SPDX-License-Identifier: MIT
#pragma once
#include <string>

namespace bench {

/// One robot of the register way with every interrupt that the library keeps running, `rounds` times ten
/// simulated seconds, printed. Returns the median of times real time on this core, processor time; -1 when
/// the robot cannot be built.
double measure_register_way(int rounds);
/// What the issue of the register way promises.
inline constexpr double kPromisedRegisterWay = 500;

}  // namespace bench
