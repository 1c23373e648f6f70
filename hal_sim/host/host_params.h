// SPDX-License-Identifier: MIT
// Numbers of the processor as native firmware meets it, each with its source (docs/sources.md).
#pragma once
#include "hal_sim/host/context.h"

namespace host {

/// Instruction clock: 7.3728 MHz crystal, PLL x8, four clocks an instruction, Hz. [lib:
/// motor_led/e_epuck_ports.h]
inline constexpr double kFcyHz = 14'745'600.0;

/// Start-up code before main(): stack, PSV, clearing and filling of data. [assumed: a few hundred words of
/// data at 2 to 4 cycles each]
inline constexpr Cycle kStartUpCycles = 1000;

/// Entry of a program's own handler and RETFIE: 4 cycles latency, 8 register pairs saved and restored, 3 to
/// return. [estimated: DS70143 5.7 and XC16's prologue]
inline constexpr Cycle kInterruptEntryCycles = 23;

/// Interrupts blocked for this long by the main program are taken for an endless loop: one second. [assumed:
/// no e-puck program masks interrupts for as long]
inline constexpr Cycle kBlockedInterruptCycles = 14'745'600;

/// Background handlers never take more than this share of the processor, percent. [assumed: beyond it the
/// main program starves on the robot as well]
inline constexpr int kMostBackgroundPercent = 95;

/// Priority at which the math error trap runs. [DS 5.3]
inline constexpr int kMathErrorPriority = 11;

}  // namespace host
