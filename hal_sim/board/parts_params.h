// SPDX-License-Identifier: MIT
// Numbers of the parts, each with one source (the tags are those of epuck_params.h). [SRF08], [SRF10],
// [CMPS03] are the makers' manuals, [GP2D120] Sharp's data sheet (docs/sources.md).
#pragma once
#include "hal_sim/board/epuck_params.h"

namespace board {

// --- ground sensors ----------------------------------------------------------------------------------------
inline constexpr int kGroundAddress = 0xC0;       // [lib: program/BTcom/BTcom.c]
inline constexpr int kGroundFirstCliff = 13;      // register [lib: program/DemoGCtronic-complete/Asercom.c]
inline constexpr double kGroundForwardM = 0.03;   // holder's place [FRM A5]
inline constexpr double kGroundSideM = 0.010;     // outer sensors, Webots; the real board's are 9 mm [FRM A5]
inline constexpr double kCliffSideM = 0.020;      // [assumed: outside the three, inside the body]
inline constexpr double kGroundHeightM = 0.0033;  // above the floor [FRM A5]
inline constexpr double kGroundNearCounts = 1000;  // at distance 0 [FRM A5]
inline constexpr double kGroundFarCounts = 300;    // at kGroundFarM and beyond [FRM A5]
inline constexpr double kGroundFarM = 0.016;       // apparent distance [FRM A5]
inline constexpr double kGroundDarkFactor =
    0.2;                                     // distance is divided by this plus the rest times red [FRM A5]
inline constexpr double kGroundNoise = 0.1;  // standard deviation, part of the value [FRM A5]
inline constexpr double kGroundSpotM =
    0.002;  // radius of what a sensor sees [assumed: reflective sensor at 3 mm]
inline constexpr Cycle kGroundPeriod =
    kFcyHz / 1000;  // a new sample [assumed: a small processor's free-running loop]

}  // namespace board
