// SPDX-License-Identifier: MIT
// Numbers of the register way (docs/sources.md).
#pragma once
#include "hal_sim/host/context.h"

namespace register_way {

/// Saving and restoring of a handler's context: eight register pairs pushed and popped, RCOUNT. Latency and
/// RETFIE are the chip's.
inline constexpr host::Cycle kSavingCycles = 16;  // [estimated: XC16's prologue and epilogue]

}  // namespace register_way
