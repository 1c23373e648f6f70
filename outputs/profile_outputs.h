// SPDX-License-Identifier: MIT
// --profile and --budgets of a run: exact times, shown or written, and held against budgets.
#pragma once
#include <string>
#include <vector>

#include "outputs/budgets.h"
#include "outputs/profile_report.h"

namespace outputs {

struct ProfileArguments {
  bool profile = false;
  std::string file, budgets;  ///< JSON instead of text; empty: text
};

class ProfileOutputs {
 public:
  ProfileOutputs(ProfileArguments arguments, twin::Twin& twin)
      : arguments_(std::move(arguments)), twin_(twin), profiles_(twin) {}
  /// False and one line per problem: no robot that runs firmware, a bad file of budgets.
  bool open(std::vector<std::string>& problems);
  /// The run is over: the file, and a line where it cannot be written.
  void write(std::vector<std::string>& problems);
  /// Text goes to stdout. False: a budget was not kept.
  bool tell() const;

 private:
  const ProfileArguments arguments_;
  twin::Twin& twin_;
  Profiles profiles_;
  Budgets budgets_;
};

}  // namespace outputs
