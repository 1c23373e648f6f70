// SPDX-License-Identifier: MIT
// `twinpuck timings`: measures hal_sim/api/timings.h. Programs make every call once and read a timer
// before and after, in both ways: what the register way takes longer is missing in the table. Handlers are
// the gaps in a loop that does nothing but read it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>

#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "tools/call_cycles.h"
#include "tools/command_line.h"
#include "tools/timing_programs.h"
#include "tools/verbs.h"

namespace fs = std::filesystem;

namespace tools {
namespace {

using timing::Gaps;
using timing::Less;
using timing::Program;
using timing::Row;

constexpr double kMostS = 4;  // simulated; a program takes a quarter

struct Timing {
  const Row& row;
  int cycles;  // measured: what the table should say
};

const char* const kTableHead = R"(/* SPDX-License-Identifier: MIT
 * What the library's calls and handlers take, in processor cycles. Of a call: what the native way charges beside what
 * the compiler estimates for the function's own code. Written by `twinpuck timings` [measured: register way], which
 * keeps what is within its tolerance; held by `make check`. Read by the run, and through takes.h by `twinpuck cycles`.
 */
#ifndef TWINPUCK_API_TIMINGS_H
#define TWINPUCK_API_TIMINGS_H

)";

/// What the timer has counted for each row, in one way. Empty, with lines in `problems`, on failure.
std::vector<std::uint16_t> counts(const Program& program, const std::string& way,
                                  std::vector<std::string>& problems) {
  const fs::path folder =
      fs::path(twin::build_folder()) / "controllers" / fmt::format("timings-{}-{}", program.name, way);
  fs::create_directories(folder);
  std::ofstream(folder / "main.c") << timing::source(program, way != "native");
  sim::WorldDesc world;
  world.models = twin::robot_models();
  world.proximity.noise_scale = 0;
  world.robots.resize(1);
  world.robots[0].name = "puck";
  world.robots[0].firmware = folder.string();
  if (program.camera) world.robots[0].own["camera"] = program.camera;
  twin::Options options;
  options.way = way;
  const auto twin = twin::Twin::open(world, options, problems);
  if (!twin) return {};
  const auto read = [&](const char* name, std::size_t words) {
    std::vector<std::uint16_t> values(words);
    const auto bytes = twin->mind(0).runner()->read_variable(name, 2 * words);
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values.data()));
    return values;
  };
  while (read("done", 1)[0] == 0) {
    if (sim::to_seconds(twin->simulation().now()) > kMostS) {
      problems.push_back(
          fmt::format("timings: {} way: the {} program did not end in {} s", way, program.name, kMostS));
      return {};
    }
    twin->simulation().step();
  }
  return read("took", program.rows.size());
}

/// Where a row stands against both measurements: what its number in the table should be. `way`: that whose
/// drivers run.
std::vector<Timing> measure(const std::string& way, std::vector<std::string>& problems) {
  std::vector<Timing> all;
  std::map<std::string, int> cycles, missing;  // of each row: measured; of that, not in the table
  for (const Program& program : timing::programs()) {
    const auto chip = counts(program, way, problems), native = counts(program, "native", problems);
    for (std::size_t n = 0; problems.empty() && n < program.rows.size(); ++n) {
      const Row& row = program.rows[n];
      const Gaps& g = row.gaps;
      const bool is_share = g.count > 0 && !g.runs_natively;
      int found = is_share ? (chip[n] * row.times + g.count / 2) / g.count : chip[n] - native[n];
      for (const Less& less : row.less) found -= less.times * (is_share ? cycles : missing).at(less.name);
      if (!is_share)
        found = row.table + static_cast<int>(std::lround(double(found) / std::max(row.times, g.count)));
      cycles[row.name] = found;
      missing[row.name] = found - row.table;
      all.push_back({row, found});
    }
  }
  return all;
}

int timings(const std::string& file, bool is_check) {
  std::vector<std::string> problems;
  const auto all = measure("register", problems);
  complain(problems);
  if (!problems.empty()) return kInternal;
  std::string table = kTableHead;
  bool is_right = true;
  for (const auto& [row, cycles] : all) {
    const bool is_near = std::abs(cycles - row.table) <= row.tolerance, is_named = *row.name != 0;
    if (!is_near && is_named)
      complain({fmt::format("{}: T_{}: got {} cycles, expected {} +- {}", file, row.name, row.table, cycles,
                            row.tolerance)});
    else if (!is_near)
      complain({fmt::format("{}: {}: takes {} cycles more in the register way, expected 0 +- {}", file,
                            row.what, cycles, row.tolerance)});
    if (is_named)
      table += fmt::format("#define T_{} {} /* {} */\n", row.name, is_near ? row.table : cycles, row.what);
    is_right = is_right && (is_near || (is_named && !is_check));
  }
  if (!is_check && !(std::ofstream(file) << table << "\n#endif\n" << std::flush)) {
    complain({file + ": cannot be written"});
    return kBadInput;
  }
  return is_right ? kPass : kTestFailed;
}

/// call_cycles.inc: written where it is not what was measured, or said to be otherwise.
int call_timings(const std::string& file, bool is_check) {
  std::vector<std::string> problems;
  std::vector<std::map<std::string, int>> levels;
  for (const char* level : {"-O0", "-O1", "-O2", "-Os"})
    levels.push_back(timing::call_cycles(level, problems));
  complain(problems);
  if (!problems.empty()) return kInternal;
  const std::string wanted = timing::call_cycles_text(levels);
  std::ifstream in(file);
  const std::string got{std::istreambuf_iterator<char>(in), {}};
  if (got == wanted) return kPass;
  if (is_check) {
    complain(
        {file + ": is not what hal_dspic's functions take on the chip; twinpuck timings writes it anew"});
    return kTestFailed;
  }
  if (!(std::ofstream(file) << wanted << std::flush)) {
    complain({file + ": cannot be written"});
    return kBadInput;
  }
  return kPass;
}

/// The table beside what the drivers take on the chip. Nothing is written: the native way shall agree with
/// the register way, whose code it is.
int show_exact() {
  std::vector<std::string> problems;
  const auto estimated = measure("register", problems), exact = measure("chip", problems);
  complain(problems);
  if (!problems.empty()) return kInternal;
  std::cout << fmt::format("{:>8} {:>9} {:>8}  cycles\n", "table", "register", "chip");
  for (std::size_t n = 0; n < exact.size(); ++n)
    if (*exact[n].row.name)
      std::cout << fmt::format("{:>8} {:>9} {:>8}  {}\n", exact[n].row.table, estimated[n].cycles,
                               exact[n].cycles, exact[n].row.what);
  return kPass;
}

}  // namespace

void add_timings(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "timings", "Measure what the library's calls and handlers take, and write their table");
  auto is_check = std::make_shared<bool>(false);
  verb->add_flag("--check", *is_check, "hold the table against the measurement instead of writing it");
  auto is_exact = std::make_shared<bool>(false);
  verb->add_flag("--exact", *is_exact,
                 "show the table beside what the calls take on the chip; writes nothing");
  verb->callback([=, &exit_code] {
    const std::string api = twin::project_root() + "/hal_sim/api/";
    exit_code = *is_exact ? show_exact() : timings(api + "timings.h", *is_check);
    if (*is_exact) return;
    if (const int calls = call_timings(api + "call_cycles.inc", *is_check); calls != kPass) exit_code = calls;
  });
}

}  // namespace tools
