// SPDX-License-Identifier: MIT
// twinpuck list: what there is to run: controllers, worlds and parts of robots; and by what names
// things are asked for.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

#include "hal_sim/board/part.h"
#include "hal_sim/faults/kinds.h"
#include "hal_sim/signals/signals.h"
#include "hal_sim/twin/firmware_store.h"
#include "install/places.h"
#include "tools/command_line.h"
#include "tools/verbs.h"

namespace tools {

namespace {

namespace fs = std::filesystem;

// what a README begins with: its first line of running text
std::string first_line(const fs::path& readme) {
  std::ifstream in(readme);
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && line[0] != '#') return line;
  return "";
}

// what a world's comment begins with: its first sentence; without one, the title
std::string description_of(const fs::path& world) {
  std::ifstream in(world);
  std::string comment, title;
  bool in_head = true;
  for (std::string line; std::getline(in, line);) {
    in_head = in_head && line.rfind('#', 0) == 0;
    if (in_head && line.find("SPDX-") == std::string::npos)
      comment += (comment.empty() ? "" : " ") + line.substr(std::min<std::size_t>(2, line.size()));
    const auto a = line.find('"'), b = line.rfind('"');
    if (line.rfind("title", 0) == 0 && b != a) title = line.substr(a + 1, b - a - 1);
  }
  const std::size_t end = comment.find(". ");
  if (comment.empty()) return title;
  return end == std::string::npos ? comment : comment.substr(0, end + 1);
}

void print(const std::string& heading, std::vector<std::pair<std::string, std::string>> rows) {
  std::sort(rows.begin(), rows.end());
  std::size_t width = 0;
  for (const auto& r : rows) width = std::max(width, r.first.size());
  std::cout << heading << "\n";
  for (const auto& [name, text] : rows)
    std::cout << "  " << name << std::string(width - name.size() + 2, ' ') << text << "\n";
}

/// Names of a world's robots, a line each: for the shell's completion.
int list_robots(const std::string& name) {
  std::vector<std::string> problems;
  const auto world = open_world(name, problems);
  complain(problems);
  if (!world) return kBadInput;
  for (const auto& robot : world->robots) std::cout << robot.name << '\n';
  return kPass;
}

int list(const std::string& what) {
  // tables that are the same wherever one stands
  if (what == "faults") {
    std::cout
        << "Faults (twinpuck run --faults FILE, --fault \"KIND PARAMETER=VALUE at=2s\"; docs/testing.md)\n"
        << faults::text_table();
    return kPass;
  }
  if (what == "signals") {
    std::cout << "Signals (conditions of faults and tests; ROBOT.NAME of another robot)\n"
              << signals::text_table()
              << "  pin(D3)  reg(T2CON.TCKPS)  var(C EXPRESSION)  $NAME: a pin, a register, a variable\n";
    return kPass;
  }
  const fs::path root = places::share_root();
  std::vector<std::pair<std::string, std::string>> controllers, worlds, supervisors;
  std::error_code none;
  for (const char* room : {"", "lab/"})
    for (const auto& entry : fs::directory_iterator(root / "firmware" / room, none)) {
      const std::string name = entry.path().filename().string();
      // Webots' controllers have their folder's name
      if (fs::exists(entry.path() / "main.c") || fs::exists(entry.path() / (name + ".c")))
        controllers.emplace_back(room + name, first_line(entry.path() / "README.md"));
    }
  for (const auto& entry : fs::directory_iterator(root / "worlds", none))
    if (entry.path().extension() == ".toml")
      worlds.emplace_back(entry.path().stem().string(), description_of(entry.path()));
  for (const auto& entry : fs::directory_iterator(root / "programs" / "supervisors", none))
    supervisors.emplace_back(entry.path().filename().string(), first_line(entry.path() / "README.md"));
  if (controllers.empty() && worlds.empty()) {
    complain({root.string() + ": list: got no controllers and no worlds, expected those of Twinpuck; "
                              "TWINPUCK_ROOT may say another "
                              "place"});
    return kNothing;
  }
  const auto wanted = [&](const char* kind) { return what.empty() || what == kind; };
  if (wanted("controllers"))
    print(places::is_installed() ? "Controllers (twinpuck run WORLD --fw ...)"
                                 : "Controllers (make run FW=...)",
          controllers);
  if (wanted("worlds"))
    print(places::is_installed() ? "Worlds (twinpuck run ...)" : "Worlds (make run WORLD=...)", worlds);
  if (wanted("supervisors")) print("Supervisors (twinpuck run WORLD --supervisor ...)", supervisors);
  if (!wanted("parts")) return kPass;
  std::vector<std::pair<std::string, std::string>> parts;
  for (const sim::PartKind& kind : board::part_kinds()) parts.emplace_back(kind.name, kind.doc);
  print("Parts ([[robot.part]] kind = \"...\" in a world)", parts);
  return kPass;
}

}  // namespace

void add_list(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand(
      "list", "List controllers, worlds, supervisors and parts; faults, signals; robots of a world");
  auto what = std::make_shared<std::string>(), world = std::make_shared<std::string>();
  verb->add_option(
          "KIND", *what,
          "controllers, worlds, supervisors or parts, all of them without it; faults, signals or robots")
      ->check(
          CLI::IsMember({"controllers", "worlds", "supervisors", "parts", "faults", "signals", "robots"}));
  verb->add_option("WORLD", *world, "whose robots");
  verb->callback([what, world, &exit_code] {
    if (*what == "robots" && world->empty())
      throw CLI::ValidationError("WORLD", "got none, expected the world whose robots are listed");
    if (*what != "robots" && !world->empty())
      throw CLI::ValidationError("WORLD", "got one, expected none: only robots are listed by world");
    exit_code = *what == "robots" ? list_robots(*world) : list(*what);
  });
}

}  // namespace tools
