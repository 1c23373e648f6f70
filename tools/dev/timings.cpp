// SPDX-License-Identifier: MIT
// `twinpuck-dev timings`: measures what hal_dspic's functions take on the chip, at each level, path by path,
// and writes hal_sim/api/call_cycles.inc, by which hal_sim charges them.
#include <fstream>
#include <iterator>
#include <map>
#include <memory>

#include "install/places.h"
#include "tools/command_line.h"
#include "tools/dev/call_cycles.h"
#include "tools/dev/verbs.h"
#include "tools/verbs.h"

namespace dev {
namespace {

/// call_cycles.inc: written where it is not what was measured, or said to be otherwise.
int timings(const std::string& file, bool is_check) {
  std::vector<std::string> problems;
  std::vector<std::map<std::string, int>> levels;
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"}) levels.push_back(call_cycles(level, problems));
  tools::complain(problems);
  if (!problems.empty()) return tools::kInternal;
  const std::string wanted = call_cycles_text(levels);
  std::ifstream in(file);
  const std::string got{std::istreambuf_iterator<char>(in), {}};
  if (got == wanted) return tools::kPass;
  if (is_check) {
    tools::complain(
        {file + ": is not what hal_dspic's functions take on the chip; twinpuck-dev timings writes it anew"});
    return tools::kTestFailed;
  }
  if (!(std::ofstream(file) << wanted << std::flush)) {
    tools::complain({file + ": cannot be written"});
    return tools::kBadInput;
  }
  return tools::kPass;
}

}  // namespace

void add_timings(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "timings", "Measure what the library's calls and handlers take, and write their table");
  auto is_check = std::make_shared<bool>(false);
  verb->add_flag("--check", *is_check, "hold the table against the measurement instead of writing it");
  verb->callback([=, &exit_code] {
    exit_code = timings(places::share_root().string() + "/hal_sim/api/call_cycles.inc", *is_check);
  });
}

}  // namespace dev
