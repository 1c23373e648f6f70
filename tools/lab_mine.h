// SPDX-License-Identifier: MIT
// A student's programs in the place of ours: which of the lab's names a folder holds, built.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hal_sim/twin/twin.h"
#include "tools/lab_table.h"

namespace tools {

/// What runs for each `firmware` of the table.
struct LabPrograms {
  std::map<std::string, std::string> images;
  std::map<std::string, std::string> missing, broken;  ///< why there is no image
};

/// Leaves the steps that run a student's program, and the exercises that have such steps.
std::vector<LabExercise> own_exercises(std::vector<LabExercise> all);

/// Finds and builds what the chosen exercises ask for in `folder`: its folders of the lab's names, or the
/// folder itself when it is a controller's. One of another name serves if `by_id`, when the exercises were
/// named. Compiler's errors go to stderr.
LabPrograms own_programs(const std::string& folder, twin::Options options,
                         const std::vector<const LabExercise*>& chosen, bool by_id);

}  // namespace tools
