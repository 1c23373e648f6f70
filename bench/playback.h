// SPDX-License-Identifier: MIT
// What the benchmarks share: a twin of a world, its wheels' angles kept and played back without
// minds, a stopwatch.
#pragma once
#include <memory>
#include <vector>

#include "hal_sim/twin/twin.h"

namespace bench {

/// Wheel angles of each robot at each tick.
using WheelTrack = std::vector<std::vector<sim::WheelAngles>>;

/// Ends the program with 2 when the world cannot be opened.
std::unique_ptr<twin::Twin> open_twin(const sim::WorldDesc& world);
WheelTrack track_wheels(const sim::WorldDesc& world, double seconds);
/// The same motion with the minds' work taken out; `track` must outlive it.
std::unique_ptr<sim::Simulation> play_back(const sim::WorldDesc& world, const WheelTrack& track);
/// Simulated seconds per second, after `warm_s` simulated seconds.
struct Speed {
  double wall = 0;
  double processor = 0;  ///< per second of processor time: what the wall clock shows on an idle machine
};
Speed timed_speed(sim::Simulation& simulation, double warm_s, double measured_s);

}  // namespace bench
