// SPDX-License-Identifier: MIT
// Numbers of microphones, codec and loudspeaker; tags as in epuck_params.h, and
//   [SP0103]  data sheet of the Knowles SP0103 microphone with amplifier, 2003
//   [SI3000]  register map of the Si3000 voiceband codec, Silicon Laboratories
#pragma once
#include "hal_sim/board/epuck_params.h"

namespace board {

// --- microphones: x forward, y left
inline constexpr int kMicrophones = 3;  // [FRM A8]
inline constexpr Place kMicrophone[kMicrophones] = {
    {0.008, -0.031},  // 0 right [FRM A8]
    {0.008, 0.031},   // 1 left [FRM A8]
    {-0.022, 0.0},    // 2 back [FRM A8]
};
inline constexpr double kMicrophoneZM = 0.035;  // m [assumed: on the main board, above the IR sensors]
// the robot's microphones are taken to be of this kind
inline constexpr double kMicSensitivityVPa = 0.0794;  // V/Pa, -22 dB, amplifier at full gain [SP0103]
inline constexpr double kMicCountsPerPa =
    kMicSensitivityVPa / kAdcReferenceV * (kAdcMax + 1);  // [derived: sensitivity and converter]
inline constexpr double kMicIdleCounts =
    2048;  // [assumed: biased at half the supply; demos expect about 2000]
// the part's own noise (35 dBA) is a tenth of a count; the converter and the supply of a
// moving robot add theirs
inline constexpr double kMicNoiseCounts = 1.5;  // standard deviation [assumed: an ordinary 12-bit converter]

// --- codec and loudspeaker
inline constexpr Cycle kCodecSampleCycles =
    2048;  // 256 bits of 8 cycles: 7200 Hz [lib: codec/e_init_dci_master.s]
static_assert(kFcyHz == 7200 * kCodecSampleCycles);
inline constexpr int kSoundBankSamples = 19044;  // [lib: codec/e_const_sound.s]
// the codec's registers and clock
inline constexpr double kCodecVolumeStepDb = 1.5;     // dB, digital volume [SI3000]
inline constexpr int kCodecVolume0Db = 0x17;          // its setting for 0 dB [SI3000]
inline constexpr double kCodecAttenuationStepDb = 6;  // dB, before the loudspeakers [SI3000]
inline constexpr double kCodecOversampling =
    1024;                                         // PLL output over sample rate, besides its divider [SI3000]
inline constexpr Place kSpeaker = {-0.013, 0.0};  // [FRM A8]
inline constexpr double kSpeakerZM = 0.035;  // m [assumed: on the top board, beside the microphones' height]
// a sine at full scale: 90 dB SPL at 10 cm, so 70 dB at 1 m
inline constexpr double kSpeakerFullScalePa =
    0.0894;  // Pa at 1 m, peak [assumed: a miniature loudspeaker of this size]

// --- processor time of the codec's interrupt
// entry, context and the reading of four samples; the handler's own C is counted besides

}  // namespace board
