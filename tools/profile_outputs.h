// SPDX-License-Identifier: MIT
// --profile and --budgets of a run: exact times, shown or written, and held against budgets.
#pragma once
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tools/budgets.h"
#include "tools/profile_report.h"

namespace tools {

struct ProfileArguments {
  bool profile = false;
  std::string file, budgets;  ///< JSON instead of text; empty: text
};

void add_profile_options(CLI::App& verb, ProfileArguments& arguments);

class ProfileOutputs {
 public:
  ProfileOutputs(ProfileArguments arguments, twin::Twin& twin)
      : arguments_(std::move(arguments)), twin_(twin), profiles_(twin) {}
  /// False and one line per problem: no robot that runs firmware, a bad file of budgets.
  bool open(std::vector<std::string>& problems);
  /// Text goes to stdout. False: a budget was not kept.
  bool finish(std::vector<std::string>& problems);

 private:
  const ProfileArguments arguments_;
  twin::Twin& twin_;
  Profiles profiles_;
  Budgets budgets_;
};

}  // namespace tools
