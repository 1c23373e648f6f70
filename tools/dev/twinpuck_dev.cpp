// SPDX-License-Identifier: MIT
// The command twinpuck-dev (verbs.h).
#include <iostream>

#include "tools/dev/verbs.h"
#include "tools/verbs.h"

int main(int argc, char** argv) {
  int exit_code = tools::kPass;
  try {
    CLI::App app{"What makers of Twinpuck generate", "twinpuck-dev"};
    app.require_subcommand(1);
    for (const auto add : {dev::add_timings, dev::add_manual, dev::add_page}) add(app, exit_code);
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      return app.exit(e) == 0 ? tools::kPass : tools::kBadInput;
    }
  } catch (const std::exception& e) {
    std::cerr << "twinpuck-dev: internal error: " << e.what() << '\n';
    return tools::kInternal;
  }
  return exit_code;
}
