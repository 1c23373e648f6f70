// SPDX-License-Identifier: MIT
// twinpuck list: what there is to run: controllers, worlds and parts of robots.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include "hal_sim/board/part.h"
#include "hal_sim/twin/twin.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

// first line of running text of a README, or of a comment
std::string first_sentence(const fs::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("title", 0) == 0 && line.find('"') != std::string::npos) {
      const auto a = line.find('"'), b = line.rfind('"');
      return line.substr(a + 1, b - a - 1);
    }
    if (file.extension() == ".md" && !line.empty() && line[0] != '#') return line;
  }
  return "";
}

void print(const std::string& heading, std::vector<std::pair<std::string, std::string>> rows) {
  std::sort(rows.begin(), rows.end());
  std::size_t width = 0;
  for (const auto& r : rows) width = std::max(width, r.first.size());
  std::cout << heading << "\n";
  for (const auto& [name, text] : rows)
    std::cout << "  " << name << std::string(width - name.size() + 2, ' ') << text << "\n";
}

int list_all() {
  const fs::path root = twin::project_root();
  std::vector<std::pair<std::string, std::string>> controllers, worlds, supervisors;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(root / "firmware", none))
    // Webots' controllers have their folder's name
    if (fs::exists(entry.path() / "main.c") ||
        fs::exists(entry.path() / (entry.path().filename().string() + ".c")))
      controllers.emplace_back(entry.path().filename().string(), first_sentence(entry.path() / "README.md"));
  for (const auto& entry : fs::directory_iterator(root / "worlds", none))
    if (entry.path().extension() == ".toml")
      worlds.emplace_back(entry.path().stem().string(), first_sentence(entry.path()));
  for (const auto& entry : fs::directory_iterator(root / "supervisor" / "programs", none))
    supervisors.emplace_back(entry.path().filename().string(), first_sentence(entry.path() / "README.md"));
  if (controllers.empty() && worlds.empty()) {
    complain(
        {root.string() +
         ": list: got no controllers and no worlds, expected a checkout of Twinpuck; set TWINPUCK_ROOT"});
    return kNothing;
  }
  print("Controllers (make run FW=...)", controllers);
  print("Worlds (make run WORLD=...)", worlds);
  print("Supervisors (twinpuck run WORLD --supervisor ...)", supervisors);
  std::vector<std::pair<std::string, std::string>> parts;
  for (const sim::PartKind& kind : board::part_kinds()) parts.emplace_back(kind.name, kind.doc);
  print("Parts ([[robot.part]] kind = \"...\" in a world)", parts);
  return kPass;
}

}  // namespace

void add_list(CLI::App& app, int& exit_code) {
  app.add_subcommand("list", "List controllers, worlds, supervisors and parts")->callback([&exit_code] {
    exit_code = list_all();
  });
}

}  // namespace tools
