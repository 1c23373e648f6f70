// SPDX-License-Identifier: MIT
// Numbers of the processor as native firmware meets it, each with its source (docs/sources.md).
#pragma once
#include "hal_sim/host/context.h"

namespace host {

/// Start-up code before main(): stack, PSV, clearing and filling of data.
inline constexpr Cycle kStartUpCycles = 1000;  // [assumed: some hundred words of data, 2 to 4 cycles each]

/// Entry of a program's own handler and RETFIE: 4 cycles latency, 8 register pairs saved and restored, 3 to
/// return.
inline constexpr Cycle kInterruptEntryCycles = 23;  // [estimated: DS70143 5.7 and XC16's prologue]

/// From the interrupt that ends Idle to the next instruction, in cycles.
inline constexpr Cycle kWakeCycles = 3;  // [assumed: the family manual names 2 to 4]

/// Interrupts blocked for this long by the main program are taken for an endless loop: one second.
inline constexpr Cycle kBlockedInterruptCycles =
    board::kFcyHz;  // [assumed: no program masks them for as long]

/// Background handlers never take more than this share of the processor, percent.
inline constexpr int kMostBackgroundPercent = 95;  // [assumed: beyond it the robot starves as well]

/// Priority at which the math error trap runs.
inline constexpr int kMathErrorPriority = 11;  // [DS 5.3]

// clocks that a program may choose by its configuration word
inline constexpr double kCrystalHz = 7372800;     // [lib: motor_led/e_epuck_ports.h]
inline constexpr double kFrcHz = 7370000;         // fast internal oscillator [DS70143 20.2]
inline constexpr double kLprcHz = 512000;         // slow internal oscillator [DS70143 20.2]
inline constexpr double kClockTolerance = 0.001;  // [assumed: FRC times 8 is 0.04 % off and does as well]

}  // namespace host
