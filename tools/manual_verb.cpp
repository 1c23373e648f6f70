// SPDX-License-Identifier: MIT
// twinpuck manual FOLDER: the pages and the completion; twinpuck manual --robots WORLD: for the completion.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "sim_core/base/input_file.h"
#include "tools/command_line.h"
#include "tools/manual.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

int write_manual(const fs::path& folder, const std::string& frame) {
  CLI::App app{"Twinpuck: the firmware twin of the e-puck robot"};
  int none = 0;
  add_verbs(app, none);
  std::string frame_text;
  if (const std::string wrong = sim::read_input_file(frame, std::size_t{1} << 20, frame_text);
      !wrong.empty()) {
    complain({frame + ": frame: " + wrong});
    return kBadInput;
  }
  std::vector<std::pair<std::string, std::string>> files = {
      {"man1/twinpuck.1", manual_of_command(app)},
      {"bash-completion/completions/twinpuck", bash_completion(app, frame_text)}};
  for (const CLI::App* verb : app.get_subcommands(
           [](const CLI::App* a) { return !a->get_group().empty() && a->get_name() != "help"; }))
    files.emplace_back("man1/twinpuck-" + verb->get_name() + ".1", manual_of_verb(*verb));
  for (const auto& [name, text] : files) {
    std::error_code failed;
    fs::create_directories((folder / name).parent_path(), failed);
    std::ofstream out(folder / name, std::ios::binary);
    if (out << text << std::flush) continue;
    complain({(folder / name).string() + ": manual: cannot be written, expected a folder for it"});
    return kBadInput;
  }
  return kPass;
}

}  // namespace

void add_manual(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("manual", "Write the pages of the manual and bash's completion")->group("");
  auto folder = std::make_shared<std::string>(), frame = std::make_shared<std::string>(),
       world = std::make_shared<std::string>();
  verb->add_option("FOLDER", *folder, "where man1/ and bash-completion/ are made");
  verb->add_option("--frame", *frame, "completion.bash.in");
  verb->add_option("--robots", *world, "a world: say the names of its robots instead");
  verb->callback([folder, frame, world, &exit_code] {
    if (world->empty()) {
      exit_code = write_manual(folder->empty() ? "." : *folder, *frame);
      return;
    }
    std::vector<std::string> problems;
    const auto loaded = open_world(*world, problems);
    if (loaded)
      for (const auto& robot : loaded->robots) std::cout << robot.name << "\n";
    complain(problems);
    exit_code = loaded ? kPass : kBadInput;
  });
}

}  // namespace tools
