// SPDX-License-Identifier: MIT
// Numbers of the parts, each with one source (the tags are those of epuck_params.h). [SRF08], [SRF10],
// [CMPS03] are the makers' manuals, [GP2D120] Sharp's data sheet (docs/dev/sources.md).
#pragma once
#include "hal_sim/board/epuck_params.h"

namespace board {

// --- ground sensors
inline constexpr int kGroundAddress = 0xC0;      // [lib: program/BTcom/BTcom.c]
inline constexpr int kGroundFirstCliff = 13;     // register [lib: program/DemoGCtronic-complete/Asercom.c]
inline constexpr double kGroundForwardM = 0.03;  // holder's place [FRM A5]
inline constexpr double kGroundSideM = 0.010;    // outer sensors, Webots; the real board's are 9 mm [FRM A5]
inline constexpr double kCliffSideM = 0.020;     // [assumed: outside the three, inside the body]
inline constexpr double kGroundNearCounts = 1000;  // at distance 0 [FRM A5]
inline constexpr double kGroundFarCounts = 300;    // at kGroundFarM and beyond [FRM A5]
inline constexpr double kGroundFarM = 0.016;       // apparent distance [FRM A5]
inline constexpr double kGroundDarkFactor =
    0.2;  // distance is divided by this plus the rest times red [FRM A5]
inline constexpr double kGroundSpotM =
    0.002;  // radius of what a sensor sees [assumed: reflective sensor at 3 mm]
inline constexpr Cycle kGroundPeriod =
    kFcyHz / 1000;  // a new sample [assumed: a small processor's free-running loop]

// --- ultrasonic ranger (SRF08, SRF10)
inline constexpr int kRangerInches = 80;                     // command [SRF08]
inline constexpr int kRangerCm = 81;                         // command [SRF08]
inline constexpr int kRangerUs = 82;                         // command [SRF08]
inline constexpr Cycle kRangingCycles = kFcyHz * 65 / 1000;  // at the greatest range [SRF08]
inline constexpr int kRangerSteps = 256;                     // of the range register [SRF08]
inline constexpr double kRangerStepM = 0.043;                // range a step [SRF08]
inline constexpr double kRangerReachM = 6;                   // farthest object detected [SRF08]
inline constexpr double kRangerNearestM = 0.03;              // nearest object told apart [SRF08]
inline constexpr double kUsPerCm = 58;              // there and back, as the firmware divides [SRF08]
inline constexpr double kUsPerInch = 148;           // there and back, as the firmware divides [SRF08]
inline constexpr double kRangerHalfBeamRad = 0.48;  // 27.5 degrees to -6 dB [SRF08]
inline constexpr double kRangerMirrorRad =
    0.44;  // 25 degrees: beyond, smooth surfaces send the sound away [assumed: smooth walls]
inline constexpr int kRangerRaysAcross = 21;     // [assumed: one every 2.75 degrees]
inline constexpr int kRangerRaysUp = 3;          // [assumed: down, level, up]
inline constexpr double kRangerForwardM = 0.02;  // before the wheels [assumed: on a turret]
inline constexpr int kRangerLightDark = 2;       // reading in darkness [SRF08]
inline constexpr int kRangerLightBright = 248;   // reading in bright light [SRF08]
inline constexpr double kRangerBrightWM2 = 1;    // W/m2 that count as bright [assumed: a lamp of 1 W/m2]
inline constexpr int kRangerNoLight = 0x80;      // register 1 of a SRF10 [SRF10]
inline constexpr int kSrf08Version = 10;         // [assumed: a late one]
inline constexpr int kSrf10Version = 6;          // [assumed: a late one]

// --- compass (CMPS03)
inline constexpr int kCompassAddress = 0xC0;  // [CMPS03]
inline constexpr int kCompassVersion = 14;    // [assumed: a late one]
inline constexpr int kCompassTurn = 3600;     // registers 2 and 3 count tenths of a degree [CMPS03]
inline constexpr Cycle kCompassPeriod = kFcyHz * 40 / 1000;  // a new bearing [CMPS03]

// --- LIS turret: memory, Sharp GP2D120, LEDs
inline constexpr int kTurretAddress = 0xA2;  // [lib: contrib/LIS_sensors_turret/e_sensext.h]
inline constexpr Cycle kTurretWriteCycles = kFcyHz * 5 / 1000;  // [assumed: 24C02 family, 5 ms a byte]
inline constexpr int kSharpChannel = 5;    // AN5 [lib: contrib/LIS_sensors_turret/e_sharp.h]
inline constexpr int kSharpSupplyBit = 7;  // of port B, low is on [lib: contrib/LIS_sensors_turret/e_sharp.h]
inline constexpr Cycle kSharpPeriod =
    kFcyHz * 287 / 10000;  // 38.3 ms less 9.6: the fastest, which the library's 30 ms suit [GP2D120]
// V = kSharpVCm / (distance + kSharpOffsetCm), through 0.40 V at 30 cm and 2.65 V at 4 cm
inline constexpr double kSharpVCm = 12.249;      // [GP2D120]
inline constexpr double kSharpOffsetCm = 0.622;  // [GP2D120]
inline constexpr double kSharpPeakCm = 3;        // nearer, the voltage falls again, to 0 [GP2D120]
inline constexpr double kSharpReachM = 0.8;      // [assumed: twice the range of the data sheet and some]
inline constexpr double kSharpForwardM = 0.03;   // [assumed: at the turret's edge]
inline constexpr double kSharpHeightM = 0.055;   // [assumed: on a turret]

}  // namespace board
