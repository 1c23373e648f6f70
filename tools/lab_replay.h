// SPDX-License-Identifier: MIT
// One run of the lab again, to be looked at: the same run, to the digest, with pictures of it.
#pragma once
#include <string>
#include <vector>

#include "tools/lab_run.h"

namespace tools {

struct ReplayArguments {
  std::string trial;  ///< EXERCISE:WORLD:SEED, with a noise scale EXERCISE:WORLD:SEED:SCALE
  std::string picture, report, record;
};

/// The exercise that a trial's name begins with; null, with a line in `problems`: there is none.
const LabExercise* replayed_exercise(const std::string& trial, const std::vector<LabExercise>& all,
                                     std::vector<std::string>& problems);

/// Runs it, writes what was asked for and says how it went. Returns the exit code.
int replay_trial(const ReplayArguments& arguments, const LabExercise& exercise, const LabSetting& setting,
                 const LabPrograms& programs);

}  // namespace tools
