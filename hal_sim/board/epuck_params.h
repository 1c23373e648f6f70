// SPDX-License-Identifier: MIT
// Every number of the e-puck that the board needs, each with one source:
//   [DS70143 ..]   the dsPIC30F6014A data sheet
//   [lib: path]    what the original library's source does (fact restated)
//   [FRM A1]       the collected robot reference (docs/sources.md), section A1
//   [measured ..]  measured by us or by a named page
//   [estimated: ..] counted by hand from the library's source
//   [assumed: ..]  chosen, with the reason
#pragma once
#include <cstddef>
#include <cstdint>

#include "hal_sim/host/context.h"

namespace board {

using host::Cycle;

// --- clock -------------------------------------------------------------------------------------------------
inline constexpr Cycle kFcyHz = 14'745'600;  // 7.3728 MHz x 8 / 4 [DS70143 table 19-1]

// --- agendas and motors ----------------------------------------------------------------------------------
inline constexpr Cycle kAgendaTickCycles = 1475;  // PR2 + 1 [lib: motor_led/advance_one_timer/e_agenda.c]
inline constexpr int kSpeedUnit = 10000;  // ticks times steps/s [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kMaxSpeed = 1000;    // steps/s [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kPowerSaveBelow = 601;  // steps/s, MAXV [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kPowerSaveSpeed = 650;  // TRESHV [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kPowerSaveTicks = kSpeedUnit / kPowerSaveSpeed;
static_assert(kPowerSaveTicks == 15);

inline constexpr Cycle kBasicMotorPrescale = 256;  // TCKPS 3 [lib: motor_led/e_motors.c]
inline constexpr int kBasicMotorUnit = 57600;      // FCY / 256 [lib: motor_led/e_motors.c]
inline constexpr Cycle kTimer3TickCycles =
    6 * 256;                                 // PR3 = 5, prescale 256 [lib: motor_led/e_motors_timer3.c]
inline constexpr int kTimer3MaxSpeed = 999;  // steps/s [lib: motor_led/e_motors_timer3.c]
inline constexpr int kTimer3Idle = 9999;     // counter at speed 0 [lib: motor_led/e_motors_timer3.c]

inline constexpr int kStepsPerTurn = 1000;  // 20 steps a turn, gear 50:1 [FRM A1]
// a loaded 20-step motor settles within a few ms of a step; 4 ms keeps speeds from 250 steps/s smooth
inline constexpr Cycle kRotorMoveCycles =
    4 * kFcyHz / 1000;  // [assumed: settling time of a small PM stepper]

// --- ADC scan --------------------------------------------------------------------------------------------
inline constexpr Cycle kScanFrameCycles =
    900;  // 3, 5 or 6 channels alike [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kScanMicroFrameCycles =
    450;  // MICRO_ONLY, ADCS 19 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr int kScanPeriod =
    65;  // interrupts from one pair to the next [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr Cycle kScanRoundCycles = kScanPeriod * kScanFrameCycles;
inline constexpr int kScanLitSlot = 3;  // PULSE_PERIOD - 1 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr int kScanLitInterrupts =
    5;  // a flash lasts from slot 63 to 3 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr Cycle kScanFlashCycles =
    4720;  // of these, with the stops of the converter between them [measured: register way]
inline constexpr int kScanAccSlot = 62;         // ACC_PROX_PERIOD - 2 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr int kScanDarkSlot = 63;        // ACC_PROX_PERIOD - 1 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr Cycle kScanLightCycles = 152;  // end of a frame to IR LED switched [measured: register way]
inline constexpr Cycle kScanFileCycles =
    117;  // end of a frame to samples in the array [measured: register way]
inline constexpr Cycle kScanTadCycles = 12;  // five channels: ADCS 23 [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kScanTadCycles3 =
    20;  // three channels: ADCS 39 [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kScanTadCycles6 = 10;  // six channels: ADCS 19 [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kScanFlagCycles = 1;   // end of the last conversion to the interrupt [register way]
inline constexpr Cycle kScanChannelTad = 15;  // SAMC 1 + conversion 14 [DS70143 20.7]
inline constexpr int kMicSamples = 100;       // MIC_SAMP_NB [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr int kAccSamples = 50;        // ACC_SAMP_NB [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kAccKeepCycles = kFcyHz / 50;  // samples are worked out as often, while poses are known
inline constexpr int kGumstixSelector = 10;   // scans a fifth pair [lib: a_d/advance_ad_scan/e_ad_conv.c]

// --- basic proximity driver ------------------------------------------------------------------------------
inline constexpr Cycle kBasicPulseCycles = 646 * 8;  // PR1 = 645, prescale 8 [lib: a_d/e_prox.c]
inline constexpr Cycle kBasicRestCycles = 3871 * 8;  // PR1 = 3870, prescale 8 [lib: a_d/e_prox.c]
inline constexpr Cycle kReadAdSampleCycles =
    320;  // call to end of sampling [estimated: 40 loop rounds of 7, set-up]
inline constexpr Cycle kReadAdCycles = 470;  // call to return [estimated: sampling, 14 TAD of 9.5, return]
inline constexpr Cycle kBasicIsrEntryCycles =
    24;  // interrupt to first e_read_ad [estimated: context, switch]

// --- IR circuit ------------------------------------------------------------------------------------------
inline constexpr int kAdcMax = 4095;           // 12 bits [DS70143 20.0]
inline constexpr double kAdcReferenceV = 3.3;  // V, the converter's supply and reference [FRM A10]
// a dim room (0.5 W/m2) then reads about 3900, as robots do, and leaves the range to the reflection
inline constexpr double kAmbientCountsPerWm2 =
    400.0;  // [assumed: typical dark readings of 3500 to 4000, FRM A4]
inline constexpr Cycle kIrSettleCycles =
    25 * kFcyHz / 1'000'000;  // time constant [assumed: library's 300 us is ample]

// --- battery ---------------------------------------------------------------------------------------------
inline constexpr double kBatteryLowV = 3.4;       // BATT_LOW detector [FRM A10]
inline constexpr double kBatteryRawAt3V4 = 2070;  // counts [lib: utility/utility.c]
inline constexpr double kBatteryRawAt4V2 = 2560;  // counts [lib: utility/utility.c]

// --- pins that several devices look at -------------------------------------------------------------------
inline constexpr int kCameraResetBit = 13;  // of port C, 1 = out of reset [lib: motor_led/e_epuck_ports.h]
inline constexpr int kCodecOnBit = 0;       // of port F, 1 = on [lib: motor_led/e_epuck_ports.h]

// --- UART ------------------------------------------------------------------------------------------------
inline constexpr int kUartBitsPerByte = 10;          // 8N1 [lib: uart/e_init_uart1.s]
inline constexpr int kUartCyclesPerBrg = 16;         // bit = 16 (BRG + 1) cycles [DS70143 18.4]
inline constexpr int kUart1Brg = 7;                  // 115,200 baud exactly [lib: uart/e_init_uart1.s]
inline constexpr int kUartFifoBytes = 4;             // transmit buffer [DS70143 18.3]
inline constexpr std::size_t kPacketBytes = 330;     // [assumed: Bluetooth serial profile's usual frame]
inline constexpr Cycle kPacketCycles = kFcyHz / 50;  // [assumed: 20 ms, a module's latency]
inline constexpr int kUartRingBytes = 64;            // receive ring [lib: uart/e_uart1_rx_char.s]

// --- body, as the world sees it: x forward, y left, z up, origin between the wheels ----------------------
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

// --- processor time of the library's interrupt handlers, entry and RETFIE included -----------------------
// of the usual variants: what the drivers' own handlers (hal_dspic) take in the register way, trace by trace
// [measured: share of a delay loop that they take in the register way]
inline constexpr Cycle kAgendaIsrCycles = 35;       // empty list
inline constexpr Cycle kAgendaListCycles = -2;      // a list with nodes
inline constexpr Cycle kAgendaNodeCycles = 13;      // one node
inline constexpr Cycle kAgendaCountCycles = 5;      // one that counts
inline constexpr Cycle kMotorHalfStepCycles = 123;  // coils on, the next half's cycle
inline constexpr Cycle kMotorOffCycles = 125;       // coils off, the next half's cycle
inline constexpr Cycle kMotorStepCycles = 107;      // coils on to stay
inline constexpr Cycle kScanRoundIsrCycles = 7521;    // 65 frames of the scan, one round
inline constexpr Cycle kScanAccIsrCycles = 186;       // of these, the frame with the accelerometer
inline constexpr Cycle kScanMicroIsrCycles = 83;      // one frame of MICRO_ONLY
inline constexpr Cycle kScanStartCycles = 15;  // from the converter's being switched on to its first frame
/// Of both Timer 2's and the converter's handler: the reset value [lib: neither file sets it; DS70143 5.2].
inline constexpr int kHandlerPriority = 4;
inline constexpr Cycle kBasicMotorIsrCycles =
    34;                                        // [estimated: shadow context, counter, phase, 4 bit writes]
inline constexpr Cycle kTimer3IsrCycles = 40;  // [estimated: context, two counters, coil clearing]

}  // namespace board
