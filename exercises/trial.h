// SPDX-License-Identifier: MIT
// One run of an exercise, and what it came to. A trial depends on its step, world, noise scale and seed
// alone, so trials may be made in any order and in several processes. The seed draws noise, the robots'
// spread and where they start.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exercises/table.h"
#include "hal_sim/runs/run.h"

namespace twin {
class Twin;
}
namespace programs {
class Team;
}

namespace lab {

struct Trial {
  const Step* step = nullptr;
  std::string world;
  std::string image;       ///< of the firmware, built; empty: as the world says
  std::string hal;         ///< of programs that the world names; empty: as the world says
  double noise_scale = 0;  ///< not a number: as the world says
  double seconds = 60;     ///< simulated, at most
  std::uint64_t seed = 1;
};

/// What a trial came to.
struct TrialEnd {
  bool ran = false;  ///< to its end, without a trap
  Measures measures;
  std::string said;                     ///< by a supervisor, at last
  std::optional<std::uint64_t> digest;  ///< of the whole run; none of a look at a sensor
  std::vector<std::string> problems;    ///< why it could not run, or what trapped
};

/// Whoever looks on while a trial runs, and changes nothing.
class TrialOnlooker {
 public:
  virtual ~TrialOnlooker() = default;
  /// False, with lines in `problems`: the trial does not run.
  virtual bool open(runs::Run& run, std::vector<std::string>& problems) = 0;
  virtual void before_run() = 0;
  virtual void after_tick() = 0;
  virtual void finish(std::vector<std::string>& problems) = 0;
};

/// Runs it. The run is the same with and without somebody who looks on.
TrialEnd run_trial(const Trial& trial, TrialOnlooker* onlooker = nullptr);

}  // namespace lab
