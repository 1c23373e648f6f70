// SPDX-License-Identifier: MIT
// twinpuck import FILE.wbt: a world of Webots becomes one of ours.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "hal_sim/twin/twin.h"
#include "hal_sim/twin/world_file.h"
#include "import/import.h"
#include "import/wbt_reader.h"
#include "install/places.h"
#include "outputs/output_folder.h"
#include "sim_core/base/input_file.h"
#include "sim_core/base/output_file.h"
#include "sim_core/load/world_loader.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

std::string place(const std::string& file, const wbt::Remark& r) {
  if (r.line == 0) return file + ": " + r.text;
  if (r.column == 0) return fmt::format("{}:{}: {}", file, r.line, r.text);
  return fmt::format("{}:{}:{}: {}", file, r.line, r.column, r.text);
}

int import(const std::string& file, std::string output, bool without_firmware) {
  std::string text;
  const std::string wrong = sim::read_input_file(file, wbt::kLongestFile, text);
  if (!wrong.empty()) {
    complain({file + ": world of Webots: " + wrong});
    return kBadInput;
  }
  std::error_code none;
  if (fs::equivalent(file, output, none)) {
    complain({output + ": -o: got the world itself, expected another name"});
    return kBadInput;
  }
  const bool was_named = !output.empty();
  if (!was_named) output = fs::path(file).replace_extension(".toml").string();
  wbt::Options options;
  options.file = fs::path(file).filename().string();
  options.folder = fs::absolute(file).parent_path().string();
  options.out_folder = fs::absolute(output).parent_path().string();
  options.without_firmware = without_firmware;
  options.has_firmware = [](const std::string& name) { return !twin::stored_controller(name).empty(); };
  options.has_program = [](const std::string& name) {
    std::error_code none;
    return fs::is_directory(places::share_root() / "programs" / "supervisors" / name, none);
  };
  options.model = board::epuck_model();
  const wbt::Imported made = wbt::import_world(text, options);
  if (!made.errors.empty()) {
    for (const wbt::Remark& e : made.errors) complain({place(file, e)});
    return kBadInput;
  }
  for (const wbt::Remark& r : made.report) complain({place(file, r)});
  std::vector<std::string> problems;
  // a world of that name may be somebody's work
  std::string there;
  if (!was_named && fs::exists(output, none) &&
      (!sim::read_input_file(output, sim::kLongestWorld, there).empty() || there != made.toml)) {
    complain({output + ": world: got a file that is another already, expected a new name; -o " + output +
              " writes over it"});
    return kBadInput;
  }
  if (!outputs::can_write(output, "world", problems)) {
    complain(problems);
    return kBadInput;
  }
  sim::OutputFile out(output);
  out.append(made.toml);
  out.close();
  if (!out.error().empty()) {
    complain({out.error()});
    return kInvalidRun;
  }
  const auto loaded = twin::parse_world(made.toml, output);
  if (!loaded.world) {
    complain({loaded.report(output)});
    return kInternal;  // what it writes can always be loaded
  }
  const auto counted = [](auto n, const char* what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
  };
  std::cout << fmt::format("{}: {}, {}, {} not carried\n", output, counted(made.robots, "robot"),
                           counted(made.objects, "object"), counted(made.report.size(), "thing"));
  return kPass;
}

}  // namespace

void add_import(CLI::App& app, int& exit_code) {
  auto* verb =
      app.add_subcommand("import", "Turn an e-puck world of Webots (.wbt, V5.0 to R2025) into one of ours");
  auto file = std::make_shared<std::string>();
  auto output = std::make_shared<std::string>();
  auto bare = std::make_shared<bool>(false);
  verb->add_option("FILE", *file, "the .wbt file")->required();
  verb->add_option("-o,--output", *output, "the world file to write; FILE.toml beside it otherwise")
      ->check(named());
  verb->add_flag("--without-firmware", *bare, "robots get no firmware, so that the world runs as it is");
  verb->callback([file, output, bare, &exit_code] { exit_code = import(*file, *output, *bare); });
}

}  // namespace tools
