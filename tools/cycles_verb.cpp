// SPDX-License-Identifier: MIT
// twinpuck cycles: what each function of a program takes: estimated from the code that is made for the PC,
// exact from a run of the chip's own program, or both beside one another.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

#include "hal_sim/cc/build.h"
#include "tools/budgets.h"
#include "tools/command_line.h"
#include "tools/profile_report.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

struct CyclesArguments {
  std::string file, world = "maze", budgets;
  double period_ms = 10, seconds = 2;
  bool with_library = false, exact = false;
};

using Exact = std::map<std::string, chip::ProfileReport::Function>;

std::string count(double cycles) { return cycles < 0 ? "no bound" : fmt::format("{:.0f}", cycles); }

std::string kind_of_image(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string head(20, '\0');
  in.read(head.data(), 20);
  return dspic::kind_of(head) == dspic::FileKind::Other ? "PC" : "chip";
}

std::vector<cc::FunctionCycles> estimates(const std::string& image, std::vector<std::string>& problems) {
  if (!fs::is_regular_file(image)) {
    problems.push_back(image + ": cycles: got a device, expected an image made by `twinpuck build`");
    return {};
  }
  auto functions = cc::function_costs(image);
  if (functions.empty())
    problems.push_back(
        image + ": cycles: got a file without a cost table, expected an image made by `twinpuck build`");
  return functions;
}

/// A run of the image in the world, by the profile of its first robot.
bool measure(const CyclesArguments& a, const std::string& image, const Budgets& budgets,
             chip::ProfileReport& report, std::vector<std::string>& problems) {
  std::optional<sim::WorldDesc> world = open_world(a.world, problems);
  if (!world) return false;
  twin::Options options;
  options.firmware = {{"*", image}};
  options.world_folder = fs::path(world->file).parent_path().string();
  const auto twin = twin::Twin::open(std::move(*world), options, problems);
  if (!twin) return false;
  Profiles profiles(*twin);
  profiles.begin("cycles", problems);
  if (!problems.empty()) return false;
  for (std::string& line : budgets.unknown(chip_runner(*twin, 0)->file()))
    problems.push_back(std::move(line));
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

void show_row(const std::string& name, double min, double mean, double max, double load, bool is_main,
              const std::string& where) {
  // main() is not called every so many milliseconds: it has no load
  std::cout << fmt::format("{:<32} {:>9} {:>9} {:>9} {:>11.2f} {:>10}  {}\n", name, count(min), count(mean),
                           count(max), micros(mean), is_main ? "" : fmt::format("{:.2f}%", 100 * load),
                           where);
}

void show_estimates(const CyclesArguments& a, const std::vector<cc::FunctionCycles>& functions) {
  std::cout << fmt::format(
      "estimated cycles at 14.7456 MHz, callees included (docs/cycles.md says how good the estimate is)\n"
      "{:<32} {:>9} {:>9} {:>9} {:>11} {:>10}  where\n",
      "function", "min", "mean", "max", "mean (us)", fmt::format("load/{:g}ms", a.period_ms));
  int of_library = 0;
  for (const auto& f : functions) {
    const std::string where = fmt::format("{}:{}", from_here(f.file), f.line);
    if (f.is_library && !a.with_library)
      ++of_library;
    else if (!f.inlined_into.empty())
      std::cout << fmt::format("{:<32} part of {}  {}\n", f.name, f.inlined_into, where);
    else
      show_row(f.name + (f.is_interrupt ? " (interrupt)" : ""), f.min, f.mean, f.max,
               f.cpu_load(a.period_ms / 1000), f.name == "main", where);
  }
  if (of_library > 0) std::cout << fmt::format("and {} functions of the library: --all\n", of_library);
}

std::string measured_in(const CyclesArguments& a) {
  return fmt::format("{:g} s of {}, handlers not included", a.seconds, a.world);
}

void show_exact(const CyclesArguments& a, const chip::ProfileReport& report) {
  std::cout << fmt::format(
      "exact cycles at 14.7456 MHz, callees included, in {}\n"
      "{:<32} {:>9} {:>9} {:>9} {:>11} {:>10} {:>7}  where\n",
      measured_in(a), "function", "min", "mean", "max", "mean (us)", fmt::format("load/{:g}ms", a.period_ms),
      "calls");
  int of_library = 0;
  for (const auto& f : report.functions) {
    if (is_library_place(from_here(f.place)) && !a.with_library) {
      ++of_library;
      continue;
    }
    const std::string name = f.name + (is_handler(f.name) ? " (interrupt)" : "");
    if (f.cycles.count == 0)
      std::cout << fmt::format("{:<32} runs on{:>52}  {}\n", name, "", from_here(f.place));
    else
      std::cout << fmt::format("{:<32} {:>9} {:>9.0f} {:>9} {:>11.2f} {:>9.2f}% {:>7}  {}\n", name,
                               f.cycles.min, f.cycles.mean(), f.cycles.max, micros(f.cycles.mean()),
                               micros(f.cycles.mean()) / a.period_ms / 10, f.cycles.count,
                               from_here(f.place));
  }
  if (of_library > 0) std::cout << fmt::format("and {} functions of the library: --all\n", of_library);
}

/// Does an exact mean lie between the estimate's least and most? If not, by how much it is off.
bool is_within(const cc::FunctionCycles& estimate, double exact) {
  return exact >= estimate.min && (estimate.max < 0 || exact <= estimate.max);
}
double off(const cc::FunctionCycles& estimate, double exact) {
  return (exact < estimate.min ? estimate.min : estimate.max) / exact - 1;
}

void show_both(const CyclesArguments& a, const std::vector<cc::FunctionCycles>& functions,
               const chip::ProfileReport& report) {
  std::cout << fmt::format(
      "cycles at 14.7456 MHz, callees included; exact: {}\n"
      "{:<28} | {:>8} {:>8} {:>8} | {:>8} {:>8} {:>8} {:>7} | {:>6}  where\n",
      measured_in(a), "function", "estim.", "mean", "max", "exact", "mean", "max", "calls", "off");
  Exact exact;
  for (const auto& f : report.functions) exact[f.name] = f;
  int of_library = 0;
  for (const auto& f : functions) {
    if (f.is_library && !a.with_library) {
      ++of_library;
      continue;
    }
    if (!f.inlined_into.empty()) continue;
    const auto found = exact.find(f.name);
    std::string measured = fmt::format("{:>8} {:>8} {:>8} {:>7} | {:>6}", "", "", "", "none", "");
    if (found != exact.end() && found->second.cycles.count == 0)
      measured = fmt::format("{:>8} {:>8} {:>8} {:>7} | {:>6}", "", "", "", "runs on", "");
    if (found != exact.end() && found->second.cycles.count > 0) {
      const chip::Spread& s = found->second.cycles;
      measured = fmt::format("{:>8} {:>8.0f} {:>8} {:>7} | {:>5}", s.min, s.mean(), s.max, s.count,
                             is_within(f, s.mean()) ? "-" : fmt::format("{:+.0f}%", 100 * off(f, s.mean())));
    }
    std::cout << fmt::format("{:<28} | {:>8} {:>8} {:>8} | {}  {}:{}\n", f.name, count(f.min), count(f.mean),
                             count(f.max), measured, from_here(f.file), f.line);
  }
  if (of_library > 0) std::cout << fmt::format("and {} functions of the library: --all\n", of_library);
}

int cycles(const CyclesArguments& a) {
  std::vector<std::string> problems;
  const bool exact = a.exact || !a.budgets.empty();
  Budgets budgets;
  if (!a.budgets.empty()) budgets.read(a.budgets, problems);
  std::string image, chip_image;
  std::vector<cc::FunctionCycles> functions;
  chip::ProfileReport report;
  twin::Options estimated;  // code of the PC knows what the chip's would take
  estimated.way = "native";
  if (problems.empty()) image = twin::provide_image(a.file, "", estimated, problems);
  if (!image.empty() && kind_of_image(image) == "chip") chip_image = std::exchange(image, "");
  if (!image.empty()) functions = estimates(image, problems);
  if (!image.empty() && problems.empty() && exact) {
    twin::Options options;
    options.way = "chip";
    chip_image = twin::provide_image(a.file, "", options, problems);
    if (problems.empty() && kind_of_image(chip_image) != "chip")
      problems.push_back(chip_image +
                         ": --exact: got a program for the PC, expected its source, or a .elf or .hex");
  }
  if (problems.empty() && !chip_image.empty()) measure(a, chip_image, budgets, report, problems);
  complain(problems);
  if (!problems.empty()) return kBadInput;
  if (chip_image.empty())
    show_estimates(a, functions);
  else if (image.empty())
    show_exact(a, report);
  else
    show_both(a, functions, report);
  int exit_code = kPass;
  for (const Budgets::Verdict& v :
       a.budgets.empty() ? std::vector<Budgets::Verdict>() : budgets.judge(report)) {
    std::cout << v.text << '\n';
    if (!v.passes) exit_code = kTestFailed;
  }
  return exit_code;
}

}  // namespace

void add_cycles(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "cycles",
      "Cycles of every function and interrupt: estimated, or exact from a run of the chip's program");
  auto a = std::make_shared<CyclesArguments>();
  verb->add_option("FILE", a->file,
                   "an image, a folder or a controller's name: estimated; a .elf or .hex of the chip: exact")
      ->required();
  verb->add_flag("--exact", a->exact, "builds the program for the chip, too, and shows both");
  verb->add_option("--world", a->world, "where the chip's program runs")->capture_default_str();
  verb->add_option("--for", a->seconds, "simulated seconds that it runs")
      ->check(between(0.001, 1e5))
      ->capture_default_str();
  verb->add_option(
      "--budgets", a->budgets,
      "TOML file of what functions and interrupts may take (docs/profile.md); exit code 1 when one takes "
      "more");
  verb->add_option("--period", a->period_ms, "the load column assumes one call every so many ms")
      ->check(between(1e-6, 1e9))
      ->capture_default_str();
  verb->add_flag("--all", a->with_library, "the library's functions, too");
  verb->callback([=, &exit_code] { exit_code = cycles(*a); });
}

}  // namespace tools
