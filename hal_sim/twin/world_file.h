// SPDX-License-Identifier: MIT
// World files as Twinpuck knows them: sim_core's, with what the other rooms contribute to them, kinds of
// robot and parts, each with its keys.
#pragma once
#include <string>
#include <vector>

#include "sim_core/load/world_loader.h"

namespace twin {

/// The kinds of robot that a world may have; the first is the default.
std::vector<sim::RobotModel> robot_models();

/// What a world's name means.
struct FoundWorld {
  std::string file;    ///< empty: nothing
  std::string notice;  ///< for people, of another world of that name that was not taken; or empty
};
/// A path, a file of the current folder without its .toml, or a world of the project: maze for
/// worlds/maze.toml. When there is none a line in `problems` says so, with a guess.
FoundWorld find_world(const std::string& name, std::vector<std::string>& problems);

/// Reads and checks a file.
sim::LoadedWorld load_world(const std::string& file);
/// The same of a text; `file` is where it comes from, for messages and relative paths.
sim::LoadedWorld parse_world(std::string_view text, const std::string& file,
                             sim::KnownWorld* known = nullptr);

}  // namespace twin
