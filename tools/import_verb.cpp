// SPDX-License-Identifier: MIT
// twinpuck import FILE.wbt: a world of Webots becomes one of ours.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"
#include "hal_sim/twin/twin.h"
#include "import/import.h"
#include "sim_core/load/world_loader.h"
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
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in.good() && !in.eof()) {
    complain({file + ": world of Webots: got a file that cannot be read, expected a .wbt file"});
    return kBadInput;
  }
  if (output.empty()) output = fs::path(file).replace_extension(".toml").string();
  wbt::Options options;
  options.file = fs::path(file).filename().string();
  options.folder = fs::absolute(file).parent_path().string();
  options.out_folder = fs::absolute(output).parent_path().string();
  options.without_firmware = without_firmware;
  options.has_firmware = [](const std::string& name) {
    return fs::is_directory(fs::path(twin::project_root()) / "firmware" / name);
  };
  options.model = board::epuck_model();
  const wbt::Imported made = wbt::import_world(text, options);
  if (!made.errors.empty()) {
    for (const wbt::Remark& e : made.errors) complain({place(file, e)});
    return kBadInput;
  }
  for (const wbt::Remark& r : made.report) complain({place(file, r)});
  std::ofstream out(output, std::ios::binary);
  out << made.toml;
  if (!out.flush()) {
    complain({output + ": world: cannot write the file"});
    return kBadInput;
  }
  const auto loaded = sim::load_world(output, {board::epuck_model()}, board::part_kinds());
  if (!loaded.world) {
    complain({loaded.report(output)});
    return kInternal;  // what it writes can always be loaded
  }
  std::cout << fmt::format("{}: {} robots, {} objects, {} things not carried\n", output, made.robots,
                           made.objects, made.report.size());
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
  verb->add_option("-o,--output", *output, "the world file to write; FILE.toml beside it otherwise");
  verb->add_flag("--without-firmware", *bare, "robots get no firmware, so that the world runs as it is");
  verb->callback([file, output, bare, &exit_code] { exit_code = import(*file, *output, *bare); });
}

}  // namespace tools
