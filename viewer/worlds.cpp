// SPDX-License-Identifier: MIT
#include "viewer/worlds.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "sim_core/load/world_loader.h"
#include "sim_core/load/world_text.h"
#include "viewer/text_file.h"

namespace viewer {

namespace fs = std::filesystem;

namespace {
constexpr std::size_t kMostWorlds = 500;
}  // namespace

const char* const kNewWorld =
    "twinpuck = 1\n\n[arena]\nsize = [1.0, 1.0]\n\n"
    "[[robot]]\nname = \"puck\"\nposition = [0.0, 0.0]\n";

nlohmann::json worlds_json(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code none;
  for (fs::directory_iterator it(folder, none), end; !none && it != end && files.size() < kMostWorlds;
       it.increment(none))
    if (it->path().extension() == ".toml" && it->path().stem().extension().empty() &&
        it->is_regular_file(none))
      files.push_back(it->path().string());
  std::sort(files.begin(), files.end());
  nlohmann::json out = nlohmann::json::array();
  for (const std::string& file : files) {
    const auto bytes = bytes_at(file, sim::kLongestWorld);
    if (!bytes) continue;
    const sim::WorldText text(plain_text(*bytes).text);
    std::string title;
    bool is_world = false;  // other programs have files of that kind, too
    for (const auto& element : text.elements()) {
      if (!element.path.empty()) continue;
      is_world |= !text.value(element.id, "twinpuck").empty();
      title = text.value(element.id, "title");
    }
    if (!is_world) continue;
    if (title.size() > 1 && title.front() == '"') title = title.substr(1, title.size() - 2);
    out.push_back({{"file", file}, {"title", title}});
  }
  return out;
}

}  // namespace viewer
