// SPDX-License-Identifier: MIT
// A world that is open and ready to step, with everybody who has a hand in it: robots and their firmware
// (twin), programs of the PC (team), what is done from outside (inputs), coverage. Command, Python module,
// library and test fixture each own one.
//
//   world, options --> Run: twin <-- team
//                            ^------ inputs, coverage
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "hal_sim/inputs/inputs.h"
#include "hal_sim/twin/coverage_run.h"
#include "hal_sim/twin/twin.h"
#include "programs/team/team.h"
#include "sim_core/base/file_uses.h"
#include "sim_core/world/world_desc.h"

namespace runs {

/// Notes what a run in that world reads because of its programs, robots' and supervisors' (those of the command
/// line in their places), and the files of serial lines.
void note_programs(const sim::WorldDesc& world, const twin::Options& options,
                   const std::vector<std::string>& supervisors, sim::FileUses& files);

class Run {
 public:
  /// Relative names of the world begin in its file's folder, unless `options` name another. `supervisors`: as
  /// Team::open() has them. Null when anything is wrong; every problem is one line in `problems`. No program
  /// of the PC is started yet: Team::before_first_tick() does that.
  static std::unique_ptr<Run> open(sim::WorldDesc world, twin::Options options,
                                   const std::vector<std::string>& supervisors,
                                   std::vector<std::string>& problems);

  twin::Twin& twin() { return *twin_; }
  programs::Team& team() { return *team_; }
  inputs::Inputs& inputs() { return *inputs_; }
  sim::Simulation& simulation() { return twin_->simulation(); }
  /// Counts of lines, where the options asked for them; null: they did not. Whoever runs the world calls its
  /// look() and finish().
  twin::CoverageRun* coverage() { return coverage_.get(); }

 private:
  Run() = default;
  // each looks at those above to its end
  std::unique_ptr<twin::Twin> twin_;
  std::unique_ptr<programs::Team> team_;
  std::unique_ptr<twin::CoverageRun> coverage_;
  std::unique_ptr<inputs::Inputs> inputs_;
};

}  // namespace runs
