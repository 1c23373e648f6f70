// SPDX-License-Identifier: MIT
// Students' programs in the place of ours: which of the lab's names a folder holds, and
// what they are built to.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exercises/table.h"
#include "hal_sim/twin/firmware_store.h"

namespace lab {

/// What runs for each `firmware` of the table (a controller of the lab).
struct Programs {
  /// Images; of a program for Webots' interfaces the folder, since each world says what such a
  /// program takes for granted.
  std::map<std::string, std::string> images;
  std::map<std::string, std::string> missing, broken;  ///< why there is none
};

/// Leaves the steps that run a student's program, and the exercises that have such steps.
std::vector<Exercise> own_exercises(std::vector<Exercise> all);

/// The names of programs that exercises ask a student for: "obstacle".
std::set<std::string> wanted_programs(const std::vector<const Exercise*>& chosen);

struct OwnFolders {
  std::map<std::string, std::string> folders;  ///< by name
  std::vector<std::string> notes;              ///< what is to be told of the choice
};
/// The folders of these names in `home`, or in its folder `controllers`; or `home` itself when it is a
/// controller's of that name, of any name if `by_id`: when exercises were named. `deep`: also further below,
/// that which lies highest.
OwnFolders find_own_folders(const std::string& home, const std::set<std::string>& wanted, bool by_id,
                            bool deep);

/// Builds what one of these folders holds. Empty, with the compiler's lines in `errors`, when that fails;
/// warnings go to options.tell.
std::string build_own_program(const std::string& folder, const twin::Options& options,
                              std::vector<std::string>& errors);

/// Both, for one student, whose programs may lie deep. Compiler's errors and notes go to stderr.
Programs own_programs(const std::string& home, twin::Options options,
                      const std::vector<const Exercise*>& chosen, bool by_id, bool deep);

/// The solutions of the lab that the exercises ask for; those that this edition has not are missing.
Programs reference_programs(const std::vector<const Exercise*>& chosen, twin::Options options,
                            std::vector<std::string>& problems);

/// What is said of a program that is not in `home`.
std::string no_program_text(const std::string& name, const std::string& home);

}  // namespace lab
