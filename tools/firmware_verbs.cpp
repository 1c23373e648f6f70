// SPDX-License-Identifier: MIT
// The verbs that look at firmware without running it: build, lint; and check, which looks at a world.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>

#include "compiler/build/build.h"
#include "hal_sim/twin/firmware_store.h"
#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "programs/build/build.h"
#include "sim_core/light/profiles.h"
#include "sim_core/load/world_loader.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

/// The folder of C files that `name` means; empty after a complaint.
std::string controller_folder(const std::string& name, const char* verb) {
  std::vector<std::string> problems;
  const std::string path = twin::find_firmware(name, "", problems);
  if (!path.empty() && !fs::is_directory(path))
    problems.push_back(path + ": " + verb + ": got a file, expected a folder with C files");
  complain(problems);
  return problems.empty() ? path : "";
}

/// A program of the PC is the PC's compiler's business.
int build_program(const std::string& name, const fs::path& output) {
  std::vector<std::string> problems;
  twin::Options options;
  options.tell = [](const std::string& line) { std::cerr << line << '\n'; };
  programs::Launch launch;
  const bool good = twin::provide_launch(name, "", options, problems, launch);
  complain(problems);
  if (!good) return kTestFailed;
  std::string words;
  for (const std::string& word : launch.words) words += (words.empty() ? "" : " ") + word;
  if (!output.empty()) {
    if (launch.files == 0) {
      complain({output.string() + ": -o: got a program that needs no compiler, expected one in C or C++"});
      return kBadInput;
    }
    std::error_code wrong;
    fs::copy_file(launch.words.front(), output, fs::copy_options::overwrite_existing, wrong);
    if (wrong) {
      complain({output.string() + ": -o: cannot be written: " + wrong.message()});
      return kBadInput;
    }
    words = output.string();
  }
  std::cout << words << ": a program of the PC"
            << (launch.files > 0 ? fmt::format(", {} {}", launch.files, launch.files == 1 ? "file" : "files")
                                 : "")
            << '\n';
  return kPass;
}

/// An image takes the place of what bears its name: that must be an image too, not a device or a source.
bool may_replace(const fs::path& output) {
  std::error_code none;
  if (output.empty() || !fs::exists(fs::symlink_status(output, none))) return true;
  const bool is_file = fs::is_regular_file(output, none);
  if (is_file) {
    std::string head(4, '\0');
    std::ifstream in(output, std::ios::binary);
    in.read(head.data(), 4);
    if (in.gcount() == 0 || head ==
                                "\x7f"
                                "ELF")
      return true;
  }
  complain({output.string() + ": -o: got " +
            (is_file ? "a file that is no image" : "something that is no file") +
            ", expected a new name, or an image to replace"});
  return false;
}

/// x.hex is asked for by its own name or by that of x.elf, beside which it lies; both are x.elf here. What a
/// robot takes is hal_dspic's. False after a complaint.
bool take_ending(cc::BuildOptions& options, const std::string& asked_hal) {
  std::string ending = options.output.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), ::tolower);
  if (ending.empty() || ending == ".elf") return true;
  if (ending != ".hex") {
    if (may_replace(options.output))
      complain({options.output.string() + ": -o: got the ending " + ending + ", expected .elf or .hex"});
    return false;
  }
  if (asked_hal == "sim") {
    complain({options.output.string() +
              ": -o: got .hex with --hal sim, whose image no robot takes, expected --hal dspic, or .elf"});
    return false;
  }
  options.hal = "dspic";
  options.output.replace_extension(".elf");
  return true;
}

int build(cc::BuildOptions options, bool counts_lines) {
  const std::string given = options.source_dir.string();
  twin::Options of_run;
  of_run.hal = options.hal;
  of_run.sanitize = options.sanitize;
  if (counts_lines) {
    of_run.coverage = "run";  // as a run builds it that counts
    if (options.optimisation.empty()) options.optimisation = "-O0";
  }
  std::vector<std::string> no_controller;
  const std::string found = twin::find_firmware(given, "", no_controller);
  options.hal = twin::hal_of(of_run, found);
  if (options.hal.empty() && !found.empty() && programs::is_pc_program(found))
    return may_replace(options.output) ? build_program(given, options.output) : kBadInput;
  if (!take_ending(options, of_run.hal) || !may_replace(options.output)) return kBadInput;
  options.source_dir = controller_folder(given, "build");
  if (options.source_dir.empty()) return kBadInput;
  options.with_texts = !options.output.empty();
  if (options.output.empty()) options.output = twin::image_file(options.source_dir.string(), of_run);
  const auto result = cc::build_image(options);
  complain(result.conflicts);
  complain(result.warnings);
  complain(result.notes);
  complain(result.errors);
  if (!result.ok) {
    const bool is_unwritten =
        std::any_of(result.errors.begin(), result.errors.end(), [](const std::string& error) {
          return error.find(", expected a file that can be written") != std::string::npos;
        });
    return is_unwritten || result.is_bad_input ? kBadInput : kTestFailed;
  }
  std::cout << fmt::format("{}: {} files compiled, {} unchanged, {:.2f} s\n{}", options.output.string(),
                           result.compiled, result.reused, result.seconds, result.size_report);
  return kPass;
}

int lint(cc::BuildOptions options) {
  options.source_dir = controller_folder(options.source_dir.string(), "lint");
  if (options.source_dir.empty()) return kBadInput;
  const auto result = cc::lint_folder(options);
  complain(result.errors);
  complain(result.warnings);
  if (result.ok) std::cout << options.source_dir.string() << ": nothing to complain about\n";
  return result.ok ? kPass : result.is_bad_input ? kBadInput : kTestFailed;
}

/// "robots 'a', 'b' and 7 more"
std::string told(const std::vector<std::string>& robots) {
  constexpr std::size_t kMostNames = 4;
  const std::size_t shown = std::min(robots.size(), kMostNames);
  std::string text = robots.size() == 1 ? "robot " : "robots ";
  for (std::size_t i = 0; i < shown; ++i) text += (i == 0 ? "'" : ", '") + robots[i] + "'";
  return robots.size() == shown ? text : fmt::format("{} and {} more", text, robots.size() - shown);
}

/// What a world names and a run would not take: firmware and supervisors.
std::vector<sim::WorldProblem> bad_programs(const sim::WorldDesc& world, const std::string& file) {
  const std::string folder = fs::path(file).parent_path().string();
  std::vector<sim::WorldProblem> out;
  std::map<std::string, std::vector<std::string>> robots;  // by what they run
  for (const auto& robot : world.robots) robots[robot.firmware].push_back(robot.name);
  std::set<std::string> known{""};
  for (const auto& robot : world.robots) {
    if (!known.insert(robot.firmware).second) continue;
    std::vector<std::string> wrong;
    const std::string path = twin::find_firmware(robot.firmware, folder, wrong);
    // what is built from source is the compiler's to judge
    if (fs::is_regular_file(path) && !programs::is_pc_program(path))
      if (const std::string error = twin::wrong_image(path); !error.empty()) wrong.push_back(error);
    for (const std::string& line : wrong)
      out.push_back(
          {robot.firmware_at.line, robot.firmware_at.column, told(robots[robot.firmware]) + ": " + line});
  }
  for (const auto& supervisor : world.supervisors) {
    std::vector<std::string> wrong;
    if (!supervisor.program.empty()) twin::find_supervisor(supervisor.program, folder, wrong);
    for (const std::string& line : wrong)
      out.push_back(
          {supervisor.program_at.line, supervisor.program_at.column,
           "supervisor '" + (supervisor.name.empty() ? supervisor.program : supervisor.name) + "': " + line});
  }
  return out;
}

/// What a run takes, and may not be meant.
std::vector<std::string> notices(const sim::WorldDesc& world, const std::string& file) {
  std::vector<std::string> out;
  for (const std::string& notice : sim::proximity_notices(world)) out.push_back(file + ": " + notice);
  for (const sim::WorldProblem& p : sim::place_notices(world))
    out.push_back(fmt::format("{}:{}:{}: {}", file, p.line, p.column, p.text));
  const std::string webots = sim::resolve_path(world, world.webots.world);
  if (!webots.empty() && !fs::exists(webots))
    out.push_back(
        fmt::format("{}: note: webots.world: got {}, which is not there: supervisors find none of "
                    "its nodes",
                    file, webots));
  return out;
}

int check(const std::vector<std::string>& names) {
  int exit_code = kPass;
  for (const auto& name : names) {
    std::vector<std::string> problems;
    const std::string file = find_world(name, problems);
    auto loaded = file.empty() ? sim::LoadedWorld{} : twin::load_world(file);
    loaded.add(bad_programs(loaded.world ? *loaded.world : loaded.draft, file));
    if (!loaded.problems.empty()) problems.push_back(loaded.report(file));
    if (!problems.empty()) {
      complain(problems);
      exit_code = kBadInput;
      continue;
    }
    std::cout << fmt::format(
        "{}: good: {} {}, {} {}, {} Hz\n", file, loaded.world->robots.size(),
        loaded.world->robots.size() == 1 ? "robot" : "robots", loaded.world->objects.size(),
        loaded.world->objects.size() == 1 ? "object" : "objects", loaded.world->physics_hz);
    for (const std::string& notice : notices(*loaded.world, file)) std::cout << notice << '\n';
  }
  return exit_code;
}

/// What a compiler is told besides the program.
void add_language(CLI::App& verb, cc::BuildOptions& o) {
  one_each(verb.add_option("-D", o.defines, "NAME or NAME=value for the preprocessor"));
  one_each(
      verb.add_option("-I", o.include_dirs, "folder that is searched for headers first")->check(folder()));
  verb.add_option("--std", o.standard, "standard of C, such as gnu99; default: the project's, or XC16's")
      ->check(
          CLI::IsMember({"c89", "c90", "c99", "c11", "c17", "gnu89", "gnu90", "gnu99", "gnu11", "gnu17"}));
}

}  // namespace

void add_build(CLI::App& app, int& exit_code) {
  auto* verb =
      app.add_subcommand("build", "Compile a folder of firmware into an image, or a program of the PC");
  auto o = std::make_shared<cc::BuildOptions>();
  o->source_dir = ".";
  verb->add_option("DIR", o->source_dir,
                   "folder with C files, or a controller's name; Webots' too; without it this folder");
  verb->add_option("-o,--output", o->output,
                   "the image to write, an .elf; without it, where runs keep theirs")
      ->check(named());
  verb->add_option("--opt", o->optimisation, "-O0 -O1 -O2 -Os; default: the project's, else -O1")
      ->check(CLI::IsMember({"-O0", "-O1", "-O2", "-Os"}));
  add_language(*verb, *o);
  add_hal(*verb, o->hal);
  verb->add_flag("--sanitize", o->sanitize, "as run --sanitize builds it");
  auto counts_lines = std::make_shared<bool>();
  verb->add_flag("--coverage", *counts_lines, "as run --coverage builds it: with -O0");
  verb->callback([o, counts_lines, &exit_code] { exit_code = build(*o, *counts_lines); });
}

void add_lint(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("lint", "Strict warnings, timer conflicts, flags that should be volatile");
  auto o = std::make_shared<cc::BuildOptions>();
  o->source_dir = ".";
  verb->add_option("DIR", o->source_dir,
                   "folder with C files, or a controller's name; without it this folder");
  add_language(*verb, *o);
  verb->callback([o, &exit_code] { exit_code = lint(*o); });
}

void add_check(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("check", "Read world files and tell everything that is wrong with them");
  auto files = std::make_shared<std::vector<std::string>>();
  verb->add_option("WORLD", *files,
                   "world files, or names of those in worlds/; without one this folder's world.toml");
  verb->callback([files, &exit_code] {
    if (files->empty()) files->push_back(world_here("WORLD"));
    exit_code = check(*files);
  });
}

}  // namespace tools
