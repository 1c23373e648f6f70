// SPDX-License-Identifier: MIT
// Worlds of Webots V5.0 to R2025 with e-pucks in them, turned into our world files. docs/webots.md says what
// is carried and how.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "import/wbt_node.h"
#include "import/wbt_reader.h"
#include "sim_core/world/world_desc.h"

namespace wbt {

struct Options {
  std::string file;    ///< name of the world, for messages
  std::string folder;  ///< where it lies; empty: no other file (pictures, PROTOs, controllers) is looked at
  std::string out_folder;         ///< where the result will lie, for relative names
  bool without_firmware = false;  ///< robots get no controller
  /// Whether the project has a controller, or a supervisor's program, of that name; may be empty.
  std::function<bool(const std::string&)> has_firmware, has_program;
  sim::RobotModel model;  ///< of an e-puck, to see whether it begins inside something
};

struct Imported {
  std::string toml;            ///< the world file; empty when there are errors
  std::vector<Remark> report;  ///< what was not carried, by line
  std::vector<Remark> errors;  ///< what is wrong with the .wbt file
  int robots = 0;
  int objects = 0;  ///< [[box]] and its like, without arenas, walls and ramps
};

/// Things for a world that runs already.
struct Furniture {
  std::vector<sim::ObjectDesc> objects;  ///< `node`: the line of the node that each was
  std::vector<sim::LampDesc> lamps;
  std::vector<Remark> report;
  int robots = 0;  ///< that were found, and left out
};

/// What nodes become in the world that `of` is the text of, whose floor lies at `floor_z` (m, upwards): its
/// release, axes, PROTOs and contactProperties count, not its nodes.
Furniture furniture_of(const std::vector<NodePtr>& nodes, const WorldText& of, const Options& options,
                       double floor_z);

/// `text`: a .wbt file. Never fails but by `errors`; time and memory are bounded for any input.
Imported import_world(std::string_view text, const Options& options);

}  // namespace wbt
