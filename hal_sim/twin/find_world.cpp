// SPDX-License-Identifier: MIT
#include <filesystem>

#include "hal_sim/twin/world_file.h"
#include "install/places.h"
#include "sim_core/base/did_you_mean.h"

namespace twin {

namespace fs = std::filesystem;

FoundWorld find_world(const std::string& name, std::vector<std::string>& problems) {
  std::error_code none;
  const fs::path worlds = places::share_root() / "worlds";
  const bool is_plain = name.find('/') == std::string::npos;
  const fs::path ours = worlds / (name + ".toml"), beside = name + ".toml";
  const bool is_ours = is_plain && fs::exists(ours, none), is_here = fs::is_regular_file(beside, none);
  // a loop of links, and a folder that cannot be entered, are the loader's to name; a folder is a controller of that
  // name, which may lie here
  const bool is_there = fs::exists(fs::symlink_status(name, none));
  if (none == std::errc::permission_denied) return {name, ""};
  const bool is_folder = is_there && fs::is_directory(name, none), is_known = is_ours || is_here;
  const fs::path within = fs::path(name) / "world.toml";
  if (is_folder && !is_known && fs::is_regular_file(within, none)) return {within.string(), ""};
  if (is_there && !(is_folder && is_known)) return {name, ""};
  // who makes a world of a name has it run
  if (is_here && is_ours && !fs::equivalent(beside, ours, none))
    return {beside.string(), name + ": world: ./" + beside.string() + " is taken, not " + ours.string() +
                                 ", which has that name, too"};
  if (is_here) return {beside.string(), ""};
  if (is_ours) return {ours.string(), ""};
  std::vector<std::string> known;
  for (const fs::path& folder : {worlds, fs::path(".")})
    for (const auto& entry : fs::directory_iterator(folder, none))
      if (entry.path().extension() == ".toml") known.push_back(entry.path().stem().string());
  const std::string guess = sim::did_you_mean(fs::path(name).stem().string(), known);
  problems.push_back(name +
                     ": world: got a name that is neither a file, with or without .toml, nor one of worlds/" +
                     (guess.empty() ? "; `twinpuck list` shows them" : "; did you mean '" + guess + "'?"));
  return {};
}

}  // namespace twin
