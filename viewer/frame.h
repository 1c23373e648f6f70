// SPDX-License-Identifier: MIT
// One state of the world as bytes for the page: docs/connecting.md, "frames". Little endian, version 1.
//
//   0 u32 "TPK1"   4 u32 world revision    8 f64 time, s     16 f64 pace, simulated s per s
//  24 u32 flags   28 u32 robots   32 u32 bodies   36 u32 values   40 u32 rays   44 u32 subscription
//  48 f64 values | f32 x y z heading of each body | u32 LEDs, u32 state of each robot | f32 x 7 of each ray
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace viewer {

enum FrameFlag : std::uint32_t { kRunning = 1, kEnded = 2 };
enum RobotState : std::uint32_t { kNoProgram = 1, kStopped = 2, kWaiting = 4, kSounding = 8 };

struct FrameHead {
  std::uint32_t revision = 0, flags = 0, subscription = 0;
  double pace = 0;
};

/// The table above for docs, in Markdown.
std::string frame_table();
/// The part that all clients share: what comes behind the values.
std::string frame_bodies(twin::Twin& twin);
/// Rays of the proximity sensors of these robots: from, to, and 0 to 1 how much of its light comes back; -1:
/// nothing was met.
std::string frame_rays(twin::Twin& twin, const std::vector<int>& robots);
std::string frame(twin::Twin& twin, const FrameHead& head, const std::vector<double>& values,
                  const std::string& bodies, const std::string& rays);

}  // namespace viewer
