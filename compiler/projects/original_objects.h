// SPDX-License-Identifier: MIT
// The original library's objects: which functions lie in one file there. The robot's linker takes a file
// whole, so a program that has one of a file's functions itself and needs another of them has the first one
// twice. Ours is linked function by function and would not notice.
#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "driver_variants.h"

namespace cc {

/// Names of functions, as in C, or labels of ours ("tp_basic_e_set_led") -> a file that has or calls them.
struct ProgramFunctions {
  std::map<std::string, std::string> own;  ///< defined and linked whatever asks for them, weak ones left out
  std::map<std::string, std::string> wanted;  ///< called, by what is linked in any case
  std::set<std::string> defined;              ///< by anything of the program's
};

/// A message for each of the original's files that cannot be linked beside the program's own functions.
/// Functions that not every copy of the library has are no reason.
std::vector<std::string> second_definitions(const ProgramFunctions& program,
                                            const std::vector<DriverChoice>& choices);

}  // namespace cc
