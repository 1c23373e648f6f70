// SPDX-License-Identifier: MIT
#include "tools/profile_outputs.h"

#include <cstring>
#include <fstream>
#include <iostream>

#include "tools/output_folder.h"

namespace tools {

void add_profile_options(CLI::App& verb, ProfileArguments& a) {
  verb.option_defaults()->group("Checks");
  verb.add_flag("--profile", a.profile,
                "exact cycles of functions, interrupts, turns of the main loop and waits, and the deepest "
                "stack");
  verb.add_option("--profile-json", a.file, "the same as a JSON file");
  verb.add_option("--budgets", a.budgets,
                  "TOML file of what functions and interrupts may take (docs/time.md); exit code 1 when "
                  "one takes more");
}

bool ProfileOutputs::open(std::vector<std::string>& problems) {
  const std::size_t before = problems.size();
  const auto& a = arguments_;
  if (!a.profile && a.file.empty() && a.budgets.empty()) return true;
  if (!a.file.empty()) can_write(a.file, "--profile-json", problems);
  if (!a.budgets.empty()) budgets_.read(a.budgets, problems);
  profiles_.begin(!a.budgets.empty() ? "--budgets"
                  : a.file.empty()   ? "--profile"
                                     : "--profile-json",
                  problems);
  for (int i = 0; i < twin_.robots() && !a.budgets.empty(); ++i)
    if (const auto* runner = chip_runner(twin_, i))
      for (std::string& line : budgets_.unknown(runner->file())) problems.push_back(std::move(line));
  return problems.size() == before;
}

bool ProfileOutputs::finish(std::vector<std::string>& problems) {
  bool kept = true;
  const auto reports = profiles_.reports();
  if (arguments_.profile)
    for (const auto& [robot, report, program] : reports) std::cout << '\n' << to_text(robot, report);
  if (!arguments_.file.empty()) {
    std::ofstream out(arguments_.file, std::ios::binary | std::ios::trunc);
    if (!(out << to_json(reports)).flush())
      problems.push_back(arguments_.file + ": --profile-json: cannot be written: " + std::strerror(errno));
  }
  if (arguments_.budgets.empty()) return true;
  for (const auto& [robot, report, program] : reports)
    for (const Budgets::Verdict& v : budgets_.judge(report, *program)) {
      std::cout << robot << ": " << v.text << '\n';
      kept = kept && v.passes;
    }
  return kept;
}

}  // namespace tools
