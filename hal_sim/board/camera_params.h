// SPDX-License-Identifier: MIT
// Every number of the camera, each with one source (docs/dev/sources.md). Register numbers stand in
// camera_sensor.cpp beside what they mean. [derived: ..] follows from the facts that it names.
#pragma once
#include "hal_sim/board/cycle.h"

namespace board {

// --- optics
inline constexpr double kCameraXM = 0.030;  // m ahead of the axle's middle [FRM A9]
inline constexpr double kCameraZM = 0.028;  // m above the floor [FRM A9]
inline constexpr int kArrayWidth = 640;     // pixels [lib: camera/fast_2_timer/e_poxxxx.h]
inline constexpr int kArrayHeight = 480;    // pixels [lib: camera/fast_2_timer/e_poxxxx.h]
// 640 columns cover 0.84 rad: 320 / tan(0.42)
inline constexpr double kFocalPx = 716.54;  // pixels of the array [FRM A9]

// --- time
// the sensor's clock is the processor's instruction clock
// PO3030K: registers 4 to 7 of the library's table hold 851 twice, line length and, by a slip, frame length
// too: 852 x 852 pixels. The authors' 1.3 and 2.6 pictures a second follow (1.27, 2.54). Integration of 998
// lines, the table's other value, makes a frame of 998 + 8 lines, from which the authors' 4.3 follow (grey
// 8.6, 4.3, 2.2).
inline constexpr int kIntegrationMargin =
    8;  // lines from integration to frame [derived: 14745600 / 4 / 852 / 4.3 - 998]
// PO6030K: 18.432 pictures a second at half the clock [measured: documentation of epucklib, camera]
inline constexpr int kPo6030LinePixels = 800;  // [derived: library's limit of 799 columns]
inline constexpr int kPo6030FrameLines = 500;  // [derived: 14745600 / 2 / 18.432 / 800]
// PO8030D
inline constexpr int kPo8030LinePixels = 776;  // [lib: camera/fast_2_timer/e_po8030d_registers.c]
inline constexpr int kPo8030FrameLines = 516;  // [lib: camera/fast_2_timer/e_po8030d_registers.c]
// longest integration of the two in automatic mode: the frame is stretched to twice its length
inline constexpr int kLongestFrames = 2;  // [measured: documentation of epucklib, rate halves in the dark]

// --- light
// white under 1 W/m2, exposed for one second at gain 1, gives this share of full scale. An ordinary bright
// scene then needs 0.25 s, where the authors' frame rates lie
inline constexpr double kResponse =
    1.4;  // [assumed: so that the room's light gives the authors' frame rates]
inline constexpr double kStartExposureS = 0.23;  // s after a reset [derived: 998 lines at the quarter clock]
inline constexpr double kLargestGain =
    8;  // of the automatic exposure [derived: registers 0xBB and 0xB9 of the library's table]
inline constexpr double kShortestLines = 1;  // [assumed: one line]
inline constexpr double kExposureStep =
    2.0;  // most that the exposure changes per frame, factor [assumed: settles within a few frames]
inline constexpr double kExposureHold =
    0.06;  // no change while the mean is that near its target, share [lib: table's 0xAE, 2 of 32]
inline constexpr double kWhiteStep =
    0.25;  // share of the way to grey per frame [assumed: settles within ten frames]
inline constexpr double kWhiteChroma =
    0.35;  // more colourful pixels are no reference for white [assumed: spares coloured objects]
inline constexpr double kWhiteLeast = 0.25;  // gain, 0x10 / 64 [lib: table's 0xC1 to 0xC4]
inline constexpr double kWhiteMost = 3.5;    // gain, 0xE0 / 64 [lib: table's 0xC1 to 0xC4]
inline constexpr int kLongestGap =
    40;  // frames that the automatics make up for at once [assumed: they have settled by then]

inline constexpr double kReadNoise =
    0.004;  // standard deviation, share of full scale [assumed: one count of 255]
// the same at full scale, growing with the root of the signal [assumed: 10,000 electrons a pixel]
inline constexpr double kShotNoise = 0.010;

inline constexpr int kRowsAtOnce =
    4;  // lines that share an instant [measured: 82 us a picture; single lines 250 us]

}  // namespace board
