// SPDX-License-Identifier: MIT
// Options of verbs that run a world and leave files behind (outputs/).
#pragma once
#include <CLI/CLI.hpp>

#include "outputs/profile_outputs.h"
#include "outputs/run_outputs.h"

namespace tools {

/// Groups Outputs, Pictures and films, and Traces.
void add_output_options(CLI::App& verb, outputs::OutputArguments& arguments);
/// After parsing: an option of an output that was not asked for, a line in `problems` each.
void refuse_without_output(const CLI::App& verb, std::vector<std::string>& problems);
/// --profile, --profile-json and --budgets, of the group Checks.
void add_profile_options(CLI::App& verb, outputs::ProfileArguments& arguments);

}  // namespace tools
