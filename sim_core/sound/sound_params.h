// SPDX-License-Identifier: MIT
// Numbers of the acoustic medium and of the sounds that worlds are made of.
#pragma once

namespace sim {

inline constexpr double kSoundSpeedMs = 343.0;         // m/s [assumed: dry air at 20 degrees Celsius]
inline constexpr double kReferencePressurePa = 20e-6;  // Pa rms at 0 dB SPL [assumed: the usual definition]
// nearer than this the 1/r law is not followed any further
inline constexpr double kNearestM = 0.02;  // m [assumed: size of a small loudspeaker]
// a robot's loudspeaker is not heard from further away, so that little of the past must be kept
inline constexpr double kSpeakerRangeM = 20.0;  // m [assumed: 26 dB below the level at 1 m, under any noise]

// white noise changes direction this often, linear in between
inline constexpr double kWhiteNoiseHz = 44100.0;  // Hz [assumed: above what microphones follow]
inline constexpr int kBandTones = 32;  // of a noise with a band [assumed: enough to look like noise]

// a hand clap: a burst of noise in a band that dies away
inline constexpr double kClapRiseS = 0.0002;   // s [assumed: less than four samples of a microphone]
inline constexpr double kClapDecayS = 0.004;   // s [assumed: a clap in a room without echoes]
inline constexpr double kClapDecays = 8;       // decay times until it is cut off [assumed: -69 dB]
inline constexpr double kClapLowHz = 500.0;    // Hz [assumed: where claps have most of their power]
inline constexpr double kClapHighHz = 5000.0;  // Hz [assumed: where claps have most of their power]
inline constexpr int kClapTones = 24;          // [assumed: enough to look like noise]
inline constexpr double kClapShortestGapS =
    0.05;  // s, between claps of a source [assumed: no hands are faster]

}  // namespace sim
