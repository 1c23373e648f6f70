// SPDX-License-Identifier: MIT
// Every number of the library's drivers that their closed forms need, each with one source (tags as in
// hal_sim/board/epuck_params.h).
#pragma once
#include "hal_sim/api/timings.h"
#include "hal_sim/board/epuck_params.h"
#include "hal_sim/board/sound_params.h"

namespace drivers {

using board::Cycle;
using board::kFcyHz;
using board::kNever;

// --- agendas and motors ----------------------------------------------------------------------------------
inline constexpr Cycle kAgendaTickCycles = 1475;  // PR2 + 1 [lib: motor_led/advance_one_timer/e_agenda.c]
inline constexpr Cycle kSpeedGrace =
    1474560;  // 0.1 s without motors, then told [assumed: no program starts them so late]
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

// --- ADC scan --------------------------------------------------------------------------------------------
inline constexpr Cycle kScanSequenceCycles =
    900;  // conversions: 3, 5 or 6 channels alike [lib: a_d/advance_ad_scan/e_ad_conv.h]
// the converter stands from a sequence's end until the handler has listed the next one's channels; the mean
// of 65 frames at -O1, XC16's own code 67, at -O0 71 and 80 [measured: hal_dspic on the chip]
inline constexpr Cycle kScanStopCycles = 65;
inline constexpr Cycle kScanFrameCycles = kScanSequenceCycles + kScanStopCycles;
inline constexpr Cycle kScanMicroFrameCycles =
    450;  // MICRO_ONLY, ADCS 19 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr int kScanPeriod =
    65;  // interrupts from one pair to the next [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr Cycle kScanRoundCycles = kScanPeriod * kScanFrameCycles;
inline constexpr int kScanLitSlot = 3;  // PULSE_PERIOD - 1 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr int kScanLitInterrupts =
    5;  // a flash lasts from slot 63 to 3 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr Cycle kScanFlashCycles =
    4841;  // of these, with the stops of the converter between them [measured: hal_dspic on the chip]
inline constexpr int kScanAccSlot = 62;   // ACC_PROX_PERIOD - 2 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr int kScanDarkSlot = 63;  // ACC_PROX_PERIOD - 1 [lib: a_d/advance_ad_scan/e_ad_conv.c]
inline constexpr Cycle kScanLightCycles =
    125;  // end of a sequence to IR LED switched [measured: hal_dspic on the chip]
inline constexpr Cycle kScanFileCycles =
    113;  // end of a sequence to samples in the array [measured: hal_dspic on the chip]
inline constexpr Cycle kScanTadCycles = 12;  // five channels: ADCS 23 [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kScanTadCycles3 =
    20;  // three channels: ADCS 39 [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kScanTadCycles6 = 10;  // six channels: ADCS 19 [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kScanFlagCycles = 1;   // end of the last conversion to the interrupt [register way]
inline constexpr Cycle kScanChannelTad = 15;  // SAMC 1 + conversion 14 [DS70143 20.7]
inline constexpr int kMicSamples = 100;       // MIC_SAMP_NB [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr int kAccSamples = 50;        // ACC_SAMP_NB [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kAccKeepCycles =
    kFcyHz / 50;  // between looks at it [assumed: half as long as poses are kept]

// --- basic proximity driver ------------------------------------------------------------------------------
inline constexpr Cycle kBasicPulseCycles = 646 * 8;  // PR1 = 645, prescale 8 [lib: a_d/e_prox.c]
inline constexpr Cycle kBasicRestCycles = 3871 * 8;  // PR1 = 3870, prescale 8 [lib: a_d/e_prox.c]
inline constexpr Cycle kReadAdSampleCycles =
    170;  // call to end of sampling [counted in XC16's code: 40 loop rounds of 4, set-up]
inline constexpr Cycle kReadAdCycles = 315;  // call to return [the same; 15 TAD of 9.5]
inline constexpr Cycle kBasicIsrEntryCycles =
    24;  // interrupt to first e_read_ad [estimated: context, switch]

// --- processor time of the library's interrupt handlers, entry and RETFIE included -----------------------
// of the usual variants: what the drivers' own handlers (hal_dspic) take in the register way
inline constexpr Cycle kAgendaIsrCycles = T_TICK;                       // empty list
inline constexpr Cycle kAgendaListCycles = T_TICK_FIRST - T_TICK_NODE;  // a list with nodes
inline constexpr Cycle kAgendaNodeCycles = T_TICK_NODE;                 // one node
inline constexpr Cycle kAgendaCountCycles = T_TICK_COUNT;               // one that counts
inline constexpr Cycle kMotorHalfStepCycles = T_MOTOR_HALF;             // coils on, the next half's cycle
inline constexpr Cycle kMotorOffCycles = T_MOTOR_OFF;                   // coils off, the next half's cycle
inline constexpr Cycle kMotorStepCycles = T_MOTOR_STEP;                 // coils on to stay
inline constexpr Cycle kScanRoundIsrCycles = T_SCAN_ROUND;              // 65 frames of the scan, one round
inline constexpr Cycle kScanAccIsrCycles = T_SCAN_ACC;      // of these, the frame with the accelerometer
inline constexpr Cycle kScanMicroIsrCycles = T_SCAN_MICRO;  // one frame of MICRO_ONLY
// from the converter's being switched on to its first frame
inline constexpr Cycle kScanStartCycles = 15;  // [measured: register way]
/// Of both Timer 2's and the converter's handler: the reset value [lib: neither file sets it; DS70143 5.2].
inline constexpr int kHandlerPriority = 4;
inline constexpr Cycle kBasicMotorIsrCycles = T_BASIC_STEP;  // a step of one wheel
inline constexpr Cycle kBasicProxIsrCycles = T_BASIC_PROX;   // both conversions of a pair
inline constexpr Cycle kTimer3IsrCycles = 40;  // [estimated: context, two counters, coil clearing]

// --- camera
inline constexpr Cycle kMaskCycles =
    8;  // per byte of a line, taken or not [lib: camera/fast_2_timer/e_interrupt.s]
// from HREF's rise to the first byte that the fast driver takes: 2 until timer 4 has counted it, 5 for the
// interrupt's entry, 10 in the handler [lib: camera/fast_2_timer/e_interrupt.s, DS70143 5.4]
inline constexpr Cycle kFirstByteCycles = 17;

// --- I2C module
inline constexpr int kI2cLibraryBrg = 150;   // I2CBRG [lib: I2C/e_I2C_master_module.c]
inline constexpr Cycle kI2cEdgeCycles = 13;  // FCY / 1,111,111 Hz, the edges' share of a bit [DS70143 17.12]
// half bits of each operation
inline constexpr int kI2cByteHalves = 16;          // a byte received, acknowledge apart [DS70143 17.12]
inline constexpr int kI2cAcknowledgedHalves = 18;  // a byte sent, acknowledge included [DS70143 17.12]
inline constexpr int kI2cAcknowledgeHalves = 2;    // [DS70143 17.12]
inline constexpr int kI2cStartHalves = 2;          // [estimated: as dspic30/periph/i2c.cpp]
inline constexpr int kI2cRestartHalves = 4;        // [estimated: as dspic30/periph/i2c.cpp]
inline constexpr int kI2cStopHalves = 3;           // [estimated: as dspic30/periph/i2c.cpp]

// --- sound
inline constexpr int kCodecGroup = 4;  // samples an interrupt [lib: codec/e_isr_dci.s]
inline constexpr Cycle kCodecGroupCycles = kCodecGroup * board::kCodecSampleCycles;
inline constexpr Cycle kDciIdleIsrCycles = T_DCI_IDLE;

// --- serial lines
inline constexpr int kUartRingBytes = 64;  // receive ring [lib: uart/e_uart1_rx_char.s]

}  // namespace drivers
