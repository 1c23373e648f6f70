// SPDX-License-Identifier: MIT
// twinpuck-dev manual FOLDER: pages and completion of the command.
#include <filesystem>
#include <fstream>
#include <memory>

#include "sim_core/base/input_file.h"
#include "tools/command_line.h"
#include "tools/dev/manual.h"
#include "tools/dev/verbs.h"
#include "tools/verbs.h"

namespace dev {

namespace {

namespace fs = std::filesystem;

int write_manual(const fs::path& folder, const std::string& frame) {
  CLI::App app{"Twinpuck: the firmware twin of the e-puck robot"};
  int none = 0;
  tools::add_verbs(app, none);
  std::string frame_text;
  if (const std::string wrong = sim::read_input_file(frame, std::size_t{1} << 20, frame_text);
      !wrong.empty()) {
    tools::complain({frame + ": frame: " + wrong});
    return tools::kBadInput;
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
    tools::complain({(folder / name).string() + ": manual: cannot be written, expected a folder for it"});
    return tools::kBadInput;
  }
  return tools::kPass;
}

}  // namespace

void add_manual(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("manual", "Write the pages of the manual and bash's completion");
  auto folder = std::make_shared<std::string>(), frame = std::make_shared<std::string>();
  verb->add_option("FOLDER", *folder, "where man1/ and bash-completion/ are made")->required();
  verb->add_option("--frame", *frame, "completion.bash.in")->required();
  verb->callback([folder, frame, &exit_code] { exit_code = write_manual(*folder, *frame); });
}

}  // namespace dev
