// SPDX-License-Identifier: MIT
// Every number of the library's drivers that their closed forms need, each with one source (tags
// as in hal_sim/board/epuck_params.h).
#pragma once
#include "hal_sim/board/epuck_params.h"
#include "hal_sim/board/sound_params.h"

namespace drivers {

using board::Cycle;
using board::kFcyHz;
using board::kNever;

// --- agendas and motors
inline constexpr Cycle kAgendaTickCycles = 1475;  // PR2 + 1 [lib: motor_led/advance_one_timer/e_agenda.c]
inline constexpr int kSpeedUnit = 10000;  // ticks times steps/s [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kMaxSpeed = 1000;    // steps/s [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kPowerSaveBelow = 601;  // steps/s, MAXV [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kPowerSaveSpeed = 650;  // TRESHV [lib: motor_led/advance_one_timer/e_motors.c]
inline constexpr int kPowerSaveTicks = kSpeedUnit / kPowerSaveSpeed;
static_assert(kPowerSaveTicks == 15);

// --- ADC scan
inline constexpr int kGumstixPosition =
    10;  // of the selector: five pairs [lib: a_d/advance_ad_scan/e_ad_conv.c]
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
inline constexpr Cycle kScanFlagCycles =
    1;  // end of the last conversion to the interrupt [measured: hal_dspic on the chip]
inline constexpr Cycle kScanChannelTad = 15;  // SAMC 1 + conversion 14 [DS70143 20.7]
inline constexpr int kMicSamples = 100;       // MIC_SAMP_NB [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr int kAccSamples = 50;        // ACC_SAMP_NB [lib: a_d/advance_ad_scan/e_ad_conv.h]
inline constexpr Cycle kAccKeepCycles =
    kFcyHz / 50;  // between looks at it [assumed: half as long as poses are kept]

inline constexpr Cycle kScanAccIsrCycles =
    161;  // the frame with the accelerometer: its handler [measured: hal_dspic on the chip]
// from the converter's being switched on to its first frame
inline constexpr Cycle kScanStartCycles = 15;  // [measured: hal_dspic on the chip]

// --- camera
inline constexpr Cycle kMaskCycles =
    8;  // per byte of a line, taken or not [lib: camera/fast_2_timer/e_interrupt.s]
// from HREF's rise to the first byte that the fast driver takes: 2 until timer 4 has counted it, 5 for the
// interrupt's entry, 10 in the handler [lib: camera/fast_2_timer/e_interrupt.s, DS70143 5.4]
inline constexpr Cycle kFirstByteCycles = 17;

// --- sound
inline constexpr int kCodecGroup = 4;  // samples an interrupt [lib: codec/e_isr_dci.s]
inline constexpr Cycle kCodecGroupCycles = kCodecGroup * board::kCodecSampleCycles;

}  // namespace drivers
