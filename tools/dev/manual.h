// SPDX-License-Identifier: MIT
// Pages of the manual and the shell's completion, made of what the verbs say of their options, so that they
// cannot differ from it. `make install` has them written; see install/rules.cmake.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace dev {

/// twinpuck.1: the command with all its verbs, exit codes, environment and files. In the macros of man(7).
std::string manual_of_command(const CLI::App& app);
/// twinpuck-VERB.1.
std::string manual_of_verb(const CLI::App& verb);
/// For bash: verbs, options, values that are known, names of worlds, controllers, supervisors and
/// robots. `frame`: completion.bash.in.
std::string bash_completion(const CLI::App& app, std::string frame);

}  // namespace dev
