// SPDX-License-Identifier: MIT
// Every number of the e-puck that the board needs, each with one source:
//   [DS70143 ..]   the dsPIC30F6014A data sheet
//   [lib: path]    what the original library's source does (fact restated)
//   [FRM A1]       the collected robot reference (docs/dev/sources.md), section A1
//   [measured ..]  measured by us or by a named page
//   [assumed: ..]  chosen, with the reason
#pragma once
#include <cstddef>

#include "hal_sim/board/cycle.h"

namespace board {

// --- motors
inline constexpr int kStepsPerTurn = 1000;  // 20 steps a turn, gear 50:1 [FRM A1]
// gear and wheel smooth steps that come in a row: 20 ms keeps speeds from 50 steps/s even
inline constexpr Cycle kRotorMoveCycles =
    kFcyHz / 50;  // [assumed: nobody sees a wheel of 50:1 stop between steps]

// --- IR circuit
inline constexpr int kAdcMax = 4095;           // 12 bits [DS70143 20.0]
inline constexpr double kAdcReferenceV = 3.3;  // V, the converter's supply and reference [FRM A10]
// a dim room (0.5 W/m2) then reads about 3900, as robots do, and leaves the range to the reflection
inline constexpr double kAmbientCountsPerWm2 =
    400.0;  // [assumed: typical dark readings of 3500 to 4000, FRM A4]
inline constexpr Cycle kIrSettleCycles =
    25 * kFcyHz / 1'000'000;  // time constant [assumed: library's 300 us is ample]

// --- battery
inline constexpr double kBatteryLowV = 3.4;       // BATT_LOW detector [FRM A10]
inline constexpr double kBatteryRawAt3V4 = 2070;  // counts [lib: utility/utility.c]
inline constexpr double kBatteryRawAt4V2 = 2560;  // counts [lib: utility/utility.c]

// --- UART
inline constexpr int kUartBitsPerByte = 10;          // 8N1 [lib: uart/e_init_uart1.s]
inline constexpr int kUartCyclesPerBrg = 16;         // bit = 16 (BRG + 1) cycles [DS70143 18.4]
inline constexpr int kUart1Brg = 7;                  // 115,200 baud exactly [lib: uart/e_init_uart1.s]
inline constexpr std::size_t kPacketBytes = 330;     // [assumed: Bluetooth serial profile's usual frame]
inline constexpr Cycle kPacketCycles = kFcyHz / 50;  // [assumed: 20 ms, a module's latency]

// --- body, as the world sees it: x forward, y left, z up, origin between the wheels
inline constexpr double kBodyRadiusM = 0.037;     // m [FRM A1]
inline constexpr double kBodyUndersideM = 0.002;  // m, bounding cylinder of 45 mm centred at 25 mm [FRM A1]
inline constexpr double kBodyTopM = 0.047;        // m [FRM A1]
inline constexpr double kMassKg = 0.150;          // kg [FRM A1]
inline constexpr double kCentreOfMassZM = 0.015;  // m [FRM A1]
inline constexpr double kInertiaKgM2 = 8.75e-5;   // kg m2 about the vertical [FRM A1]
inline constexpr double kWheelRadiusM = 0.0205;   // m, 41 mm diameter [FRM A1]
inline constexpr double kAxleM = 0.053;           // m [FRM A1]

struct Place {
  double x_m, y_m;
};
struct SensorPlace {
  double x_m, y_m, yaw_deg;  // yaw counter-clockwise from forward
};
inline constexpr double kProximityZM = 0.033;  // m [FRM A2]
inline constexpr SensorPlace kProximity[8] = {
    {0.030, -0.010, -17.2},    // ps0, front right; then clockwise seen from above [FRM A2]
    {0.022, -0.025, -45.9},    // ps1 [FRM A2]
    {0.000, -0.031, -90.0},    // ps2 [FRM A2]
    {-0.030, -0.015, -151.5},  // ps3 [FRM A2]
    {-0.030, 0.015, 151.2},    // ps4 [FRM A2]
    {0.000, 0.031, 90.0},      // ps5 [FRM A2]
    {0.022, 0.025, 45.8},      // ps6 [FRM A2]
    {0.030, 0.010, 17.1},      // ps7 [FRM A2]
};
inline constexpr Place kRingLeds[8] = {
    {0.0337, 0.0},      // LED 0, front; then clockwise [FRM A10]
    {0.022, -0.025},    // LED 1 [FRM A10]
    {0.0, -0.0337},     // LED 2 [FRM A10]
    {-0.027, -0.0201},  // LED 3 [FRM A10]
    {-0.033, 0.0},      // LED 4 [FRM A10]
    {-0.027, 0.0201},   // LED 5 [FRM A10]
    {0.0, 0.0337},      // LED 6 [FRM A10]
    {0.022, 0.025},     // LED 7 [FRM A10]
};
inline constexpr Place kBodyLed = {0.0, 0.0};         // [assumed: the glow fills the transparent body]
inline constexpr Place kFrontLed = {0.031, -0.0125};  // [FRM A10]
inline constexpr double kRingLedZM = 0.040;           // m [assumed: the light ring below the top of the body]
inline constexpr double kRingLedSpotM =
    0.008;                                    // m [assumed: the ring spreads the light over some millimetres]
inline constexpr double kFrontLedZM = 0.020;  // m [assumed: beside the camera]
inline constexpr double kFrontLedSpotM = 0.004;  // m [assumed: a 5 mm lens and its halo]

}  // namespace board
