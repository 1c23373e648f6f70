// SPDX-License-Identifier: MIT
// One run of the lab again, to be looked at: the same run, to the digest, with pictures of it.
#pragma once
#include <string>
#include <vector>

#include "exercises/run.h"

namespace tools {

struct ReplayArguments {
  std::string trial;  ///< EXERCISE:WORLD:SEED, with a noise scale EXERCISE:WORLD:SEED:SCALE
  std::string picture, report, record;
};

/// The exercise that a trial's name begins with; null, with a line in `problems`: there is none.
const lab::Exercise* replayed_exercise(const std::string& trial, const std::vector<lab::Exercise>& all,
                                       std::vector<std::string>& problems);

/// Runs it, writes what was asked for and says how it went. Returns the exit code.
int replay_trial(const ReplayArguments& arguments, const lab::Exercise& exercise, const lab::Setting& setting,
                 const lab::Programs& programs);

}  // namespace tools
