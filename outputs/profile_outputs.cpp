// SPDX-License-Identifier: MIT
#include "outputs/profile_outputs.h"

#include <iostream>

#include "outputs/output_folder.h"
#include "sim_core/base/output_file.h"

namespace outputs {

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
      for (std::string& line : budgets_.unknown(runner->image()->file())) problems.push_back(std::move(line));
  return problems.size() == before;
}

void ProfileOutputs::write(std::vector<std::string>& problems) {
  if (arguments_.file.empty()) return;
  sim::OutputFile out(arguments_.file, "--profile-json");
  out.append(to_json(profiles_.reports()));
  out.close();
  if (!out.error().empty()) problems.push_back(out.error());
}

bool ProfileOutputs::tell() const {
  bool kept = true;
  const auto reports = profiles_.reports();
  if (arguments_.profile)
    for (const auto& [robot, report, program] : reports) std::cout << '\n' << to_text(robot, report);
  if (arguments_.budgets.empty()) return true;
  for (const auto& [robot, report, program] : reports)
    for (const Budgets::Verdict& v : budgets_.judge(report, *program)) {
      std::cout << robot << ": " << v.text << '\n';
      kept = kept && v.passes;
    }
  return kept;
}

}  // namespace outputs
