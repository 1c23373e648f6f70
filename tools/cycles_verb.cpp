// SPDX-License-Identifier: MIT
// twinpuck cycles: what each function of a program takes on the chip, exactly: in a run, and from its code
// alone where that is straight or branches without loops.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

#include "hal_sim/chip/code_cycles.h"
#include "hal_sim/chip/library_sources.h"
#include "hal_sim/chip/named_functions.h"
#include "outputs/budgets.h"
#include "outputs/profile_report.h"
#include "tools/command_line.h"
#include "tools/program_file.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

struct CyclesArguments {
  std::string file, world = "maze", budgets, optimisation;
  std::vector<std::string> budget;
  double period_ms = 10, seconds = 2;
  bool with_library = false, lines = false;
};

/// The program of the chip that was asked for: built for it, or a file. Empty: lines in `problems`.
std::string image_of(const std::string& name, const std::string& optimisation, dspic::FirmwareFile& file,
                     std::vector<std::string>& problems) {
  twin::Options options;
  options.hal = "dspic";  // with the code of all drivers
  options.optimisation = optimisation;
  std::string image = twin::provide_image(name, "", options, problems);
  file = chip::firmware_file();
  std::string bytes, error;
  if (image.empty()) return "";
  if (!fs::is_regular_file(image))
    error = image + ": cycles: got a device, expected a controller, a folder, or a .elf or .hex";
  else if (!read_file(image, bytes) || dspic::kind_of(bytes) == dspic::FileKind::Other)
    error =
        image + ": cycles: got no program of the chip, expected a controller, a folder, or a .elf or .hex";
  else
    dspic::load_firmware(bytes, image, file, error);
  if (error.empty()) return image;
  problems.push_back(error);
  return "";
}

/// A run of the image in the world, by the profile of its first robot.
bool measure(const CyclesArguments& a, const std::string& image, chip::ProfileReport& report,
             std::vector<std::string>& problems) {
  std::optional<sim::WorldDesc> world = open_world(a.world, problems);
  if (!world) return false;
  twin::Options options;
  options.firmware = {{"*", image}};
  options.world_folder = fs::path(world->file).parent_path().string();
  const auto twin = twin::Twin::open(std::move(*world), options, problems);
  if (!twin) return false;
  outputs::Profiles profiles(*twin);
  profiles.begin("cycles", problems);
  if (!problems.empty()) return false;
  while (twin->simulation().now() < sim::from_seconds(a.seconds))
    twin->simulation().advance(sim::from_seconds(a.seconds));
  report = profiles.reports()[0].report;
  return true;
}

/// "_T2Interrupt (interrupt)"
bool is_handler(const std::string& name) {
  return name[0] == '_' && name.size() > 9 && name.compare(name.size() - 9, 9, "Interrupt") == 0;
}

/// One function of the program, as it was called and as its code is.
struct FunctionRow {
  std::string name, place;
  const chip::ProfileReport::Function* run = nullptr;  // null: it never ran
  bool has_code = false;
  std::uint32_t begin = 0, end = 0;
  chip::PathCycles code;
  std::set<std::string> part_of;  // functions that hold copies of it
};

std::string place_text(const dspic::FirmwareFile& file, std::uint32_t address) {
  const auto* const row = file.code.line_at(address);
  return row ? fmt::format("{}:{}", file.code.lines().files[row->file], row->line) : "";
}
std::string place_text(const dspic::FirmwareFile& file, const dspic::DebugInfo::Function& f) {
  const int source = dspic::source_of(file, f);
  return source < 0 ? ""
                    : fmt::format("{}:{}", file.code.lines().files[static_cast<std::size_t>(source)], f.line);
}

/// The functions that ran by their own time, then the others, then those that stand in others alone.
std::vector<FunctionRow> function_rows(const dspic::FirmwareFile& file, const chip::ProfileReport& report) {
  chip::CodeCycles cycles(file);
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  std::vector<FunctionRow> rows;
  const auto row_of = [&](const std::string& name, const std::string& place) -> FunctionRow& {
    const auto [at, is_new] = known.emplace(std::pair(name, place), rows.size());
    if (is_new) {
      rows.emplace_back();
      rows.back().name = name;
      rows.back().place = place;
    }
    return rows[at->second];
  };
  std::map<std::string, std::string> places;
  for (const auto& f : report.functions) row_of(f.name, f.place).run = &f;
  for (const auto& f : file.code.functions) {
    FunctionRow& row = row_of(f.name, place_text(file, f.begin));
    row.has_code = true;
    row.begin = f.begin;
    row.end = f.end;
    row.code = cycles.of_function(f.begin);
    places.emplace(f.name, row.place);
  }
  for (const auto& f : file.debug.value().functions) {
    if (f.inlined_at.empty()) continue;
    const bool has_code = f.end > 0 && places.count(f.name);
    FunctionRow& row = row_of(f.name, has_code ? places[f.name] : place_text(file, f));
    for (const std::uint32_t address : f.inlined_at)
      if (const auto* in = file.code.function_at(address)) row.part_of.insert(in->name);
  }
  return rows;
}

std::string range(const chip::PathCycles& code) {
  if (!code.is_known()) return "-";
  return code.least == code.most ? fmt::format("{}", code.least)
                                 : fmt::format("{} to {}", code.least, code.most);
}

void show_row(const CyclesArguments& a, const FunctionRow& row) {
  const std::string name = row.name + (is_handler(row.name) ? " (interrupt)" : ""),
                    in = fmt::format("{}", fmt::join(row.part_of, ", "));
  if (!row.has_code && !row.run) {
    std::cout << fmt::format("{:<32} part of {}  {}\n", name, in, outputs::from_here(row.place));
    return;
  }
  std::string run = fmt::format("{:>9} {:>9} {:>9} {:>11} {:>10} {:>7} {:>9}", "", "", "", "", "", 0, "");
  if (row.run && row.run->cycles.count == 0)
    run = fmt::format("{:>9} {:>9} {:>9} {:>11} {:>10} {:>7} {:>9}", "runs on", "", "", "", "", "", "");
  if (row.run && row.run->cycles.count > 0) {
    const chip::Spread& c = row.run->cycles;
    run = fmt::format("{:>9} {:>9.0f} {:>9} {:>11.2f} {:>9.2f}% {:>7} {:>9.0f}", c.min, c.mean(), c.max,
                      outputs::micros(c.mean()), outputs::micros(c.mean()) / a.period_ms / 10, c.count,
                      static_cast<double>(row.run->own) / static_cast<double>(c.count));
  }
  std::cout << fmt::format("{:<32} {} {:>15}  {}", name, run, range(row.code), outputs::from_here(row.place));
  if (row.has_code && !row.code.is_known()) std::cout << "; only a run tells: it " << row.code.why_not;
  if (!row.part_of.empty()) std::cout << "; copies of it are part of " << in;
  std::cout << '\n';
}

void show(const CyclesArguments& a, const std::vector<FunctionRow>& rows) {
  std::cout << fmt::format(
      "exact cycles at 14.7456 MHz, callees included, in {:g} s of {}, handlers not included\n"
      "{:<32} {:>9} {:>9} {:>9} {:>11} {:>10} {:>7} {:>9} {:>15}  where\n",
      a.seconds, a.world, "function", "min", "mean", "max", "mean (us)",
      fmt::format("load/{:g}ms", a.period_ms), "calls", "own", "by its code");
  int of_library = 0;
  // a HEX file says of none whose it is
  const bool all = a.with_library ||
                   std::all_of(rows.begin(), rows.end(), [](const auto& row) { return row.place.empty(); });
  for (const FunctionRow& row : rows)
    if (outputs::is_library_place(outputs::from_here(row.place)) && !all)
      ++of_library;
    else
      show_row(a, row);
  if (std::any_of(rows.begin(), rows.end(), [&](const FunctionRow& row) {
        return !row.part_of.empty() && (all || !outputs::is_library_place(outputs::from_here(row.place)));
      }))
    std::cout << "part of others" << chip::kMeasureAlone << '\n';
  if (of_library > 0) std::cout << fmt::format("and {} functions of the library: --all\n", of_library);
}

/// The lines of a source, from 1 on; none: it is not here.
std::vector<std::string> text_of(const std::string& file) {
  std::vector<std::string> lines{""};
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

void show_lines(const CyclesArguments& a, const dspic::FirmwareFile& file,
                const std::vector<FunctionRow>& rows) {
  const chip::CodeCycles cycles(file);
  std::map<std::string, std::vector<std::string>> texts;
  for (const FunctionRow& row : rows) {
    if (!row.has_code || (outputs::is_library_place(outputs::from_here(row.place)) && !a.with_library))
      continue;
    std::cout << fmt::format("\n{}()  {}\n{:>7} {:>12} {:>13}\n", row.name, outputs::from_here(row.place),
                             "line", "instructions", "cycles");
    for (const auto& line : cycles.lines(row.begin, row.end)) {
      if (!texts.count(line.file)) texts[line.file] = text_of(line.file);
      const auto& text = texts[line.file];
      std::string said = line.line > 0 && static_cast<std::size_t>(line.line) < text.size()
                             ? text[static_cast<std::size_t>(line.line)]
                             : "";
      if (!line.calls.empty()) said += fmt::format("   ; + {}", fmt::join(line.calls, ", "));
      if (line.repeats) said += "   ; + repeats";
      std::cout << fmt::format("{:>7} {:>12} {:>13}  {}\n", line.line, line.instructions,
                               range({line.least, line.most, ""}), said);
    }
  }
}

int cycles(const CyclesArguments& a) {
  std::vector<std::string> problems;
  outputs::Budgets budgets;
  if (!a.budgets.empty()) budgets.read(a.budgets, problems);
  for (const std::string& budget : a.budget) budgets.add(budget, problems);
  dspic::FirmwareFile file;
  chip::ProfileReport report;
  const std::string image = problems.empty() ? image_of(a.file, a.optimisation, file, problems) : "";
  if (problems.empty())
    for (std::string& line : budgets.unknown(file)) problems.push_back(std::move(line));
  if (problems.empty()) measure(a, image, report, problems);
  complain(problems);
  if (!problems.empty()) return kBadInput;
  const std::vector<FunctionRow> rows = function_rows(file, report);
  show(a, rows);
  if (a.lines) show_lines(a, file, rows);
  int exit_code = kPass;
  std::map<std::string, double> most;
  for (const FunctionRow& row : rows)
    if (row.has_code && row.code.is_known()) most[row.name] = static_cast<double>(row.code.most);
  for (const outputs::Budgets::Verdict& v : budgets.judge(report, file, most)) {
    std::cout << v.text << '\n';
    if (!v.passes) exit_code = kTestFailed;
  }
  return exit_code;
}

}  // namespace

void add_cycles(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "cycles", "Exact cycles of every function and interrupt of a program: in a run, and from its code");
  auto a = std::make_shared<CyclesArguments>();
  verb->add_option("FILE", a->file, "a folder or a controller's name, or a .elf or .hex of the chip")
      ->required();
  verb->add_option("--world", a->world, "where it runs")->capture_default_str();
  verb->add_option("--for", a->seconds, "simulated seconds that it runs")
      ->check(between(0.001, 1e5))
      ->capture_default_str();
  verb->add_option("--opt", a->optimisation,
                   "level for a program that is built; default: the project's, else -O1")
      ->check(CLI::IsMember({"-O0", "-O1", "-O2", "-Os"}));
  verb->add_flag("--lines", a->lines, "source lines with the cycles of their instructions, too");
  verb->add_option(
      "--budget", a->budget,
      "NAME=CYCLES: what a call of a function may take at most; exit code 1 when one takes more");
  verb->add_option(
      "--budgets", a->budgets,
      "TOML file of what functions and interrupts may take (docs/time.md); exit code 1 when one takes "
      "more");
  verb->add_option("--period", a->period_ms, "the load column assumes one call every so many ms")
      ->check(between(1e-6, 1e9))
      ->capture_default_str();
  verb->add_flag("--all", a->with_library, "the library's functions, too");
  verb->callback([=, &exit_code] { exit_code = cycles(*a); });
}

}  // namespace tools
