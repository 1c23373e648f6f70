// SPDX-License-Identifier: MIT
// Limits of the board's checks (docs/controllers.md).
#pragma once
#include "hal_sim/board/epuck_params.h"

namespace board {

// the library asks for up to 1000 steps/s and gets them, e-pucks lose steps above; a tenth is left for jitter
inline constexpr Cycle kPullOutCycles = kFcyHz / 1100;  // per step [assumed: from FRM A1, 1000 steps/s hold]
// patterns that pass while a driver changes coil after coil (some us) do not move a rotor: in 50 us a rotor
// that needs 1 ms for a step has turned by (0.05)^2 of it, and the pattern that follows decides
inline constexpr Cycle kPatternCycles = kFcyHz / 20'000;  // [assumed: a quarter of a per cent of a step]
// the slowest step that anybody drives with coils on is tens of ms
inline constexpr Cycle kRestCycles = kFcyHz;  // 1 s without a step [assumed: well above a slow driver's step]
// the library's flash lasts 0.3 to 0.35 ms
inline constexpr Cycle kLongPulseCycles = kFcyHz / 100;  // 10 ms [assumed: thirty of the library's flashes]
inline constexpr int kVainWrites =
    3;  // changes of a pin's latch while it is an input [assumed: not by chance]

}  // namespace board
