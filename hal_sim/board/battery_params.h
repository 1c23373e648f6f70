// SPDX-License-Identifier: MIT
// Numbers of the battery and of what each device draws; tags as in epuck_params.h. Regulators of the e-puck
// are linear, so a device's current is the battery's. No measured figures of single devices were found: the
// shares are assumed, and their sum is held against the published endurance (tests/board/battery_test.cpp).
#pragma once

namespace board {

inline constexpr double kBatteryWh = 5.0;           // Wh, rested and full to empty [FRM A10]
inline constexpr double kInnerResistanceOhm = 0.2;  // [assumed: small Li-ion cell with protection circuit]

struct CellPoint {
  double charge;  // share of a full battery
  double rest_v;  // V after a rest
};
// 3.0 V empty and 4.2 V full [FRM A10]; between them the usual curve of a lithium-ion cell
inline constexpr CellPoint kCell[] = {
    {0.00, 3.00},  // [FRM A10]
    {0.05, 3.45},  // [assumed: typical lithium-ion discharge at small current]
    {0.10, 3.68},  // [assumed: as above]
    {0.20, 3.74},  // [assumed: as above]
    {0.30, 3.77},  // [assumed: as above]
    {0.40, 3.79},  // [assumed: as above]
    {0.50, 3.82},  // [assumed: as above]
    {0.60, 3.87},  // [assumed: as above]
    {0.70, 3.92},  // [assumed: as above]
    {0.80, 3.98},  // [assumed: as above]
    {0.90, 4.06},  // [assumed: as above]
    {1.00, 4.20},  // [FRM A10]
};

// currents, A
inline constexpr double kProcessorA = 0.050;  // busy waits draw it too [assumed: 3.3 V at 15 MIPS]
inline constexpr double kBluetoothA = 0.060;  // module with an open link [assumed: class 2 module]
inline constexpr double kBoardA = 0.020;      // regulators, microphones, accelerometer, receiver [assumed]
inline constexpr double kCameraA = 0.030;     // while out of reset [assumed: VGA sensor at 15 MHz]
inline constexpr double kCoilA = 0.060;      // each energised coil [assumed: makes driving last 3 h, FRM A10]
inline constexpr double kRingLedA = 0.005;   // each [assumed: indicator LED behind a resistor]
inline constexpr double kBodyLedA = 0.020;   // four green ones together [assumed: as above]
inline constexpr double kFrontLedA = 0.015;  // [assumed: bright red LED]
inline constexpr double kIrEmitterA = 0.050;  // each, while lit; a line has two [assumed: small IR reflector]
inline constexpr double kCodecA = 0.020;      // codec and amplifier at rest [assumed: Si3000 class codec]

}  // namespace board
