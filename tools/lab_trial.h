// SPDX-License-Identifier: MIT
// One run of an exercise, and what it came to. A trial depends on its step, world, noise scale and seed
// alone, so trials may be made in any order and in several processes. The seed draws noise, the robots'
// spread and where they start.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/lab_table.h"

namespace tools {

struct Trial {
  const LabStep* step = nullptr;
  std::string world;
  std::string image;       ///< of the firmware, built; empty: as the world says
  std::string hal;         ///< of programs that the world names; empty: as the world says
  double noise_scale = 0;  ///< not a number: as the world says
  double seconds = 60;     ///< simulated, at most
  std::uint64_t seed = 1;
};

/// Runs it. False, with lines in `problems`, when it could not run or a firmware trapped. `said`: the last
/// line of a supervisor of the world.
bool run_trial(const Trial& trial, Measures& measures, std::string& said, std::vector<std::string>& problems);

}  // namespace tools
