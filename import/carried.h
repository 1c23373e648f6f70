// SPDX-License-Identifier: MIT
// The world as it will be written: our own description, and beside it what the description has no place for.
#pragma once
#include <string>
#include <vector>

#include "import/import.h"
#include "import/report.h"
#include "import/scene.h"

namespace wbt {

struct Carried {
  sim::WorldDesc world;
  std::vector<std::string> info;         ///< WorldInfo's own words
  std::string arena_from, floor_from;    ///< which nodes they were
  std::string profile;                   ///< of [proximity]; empty: none is written
  std::vector<std::string> object_from;  ///< one per object
  std::vector<std::string> ramp_from;    ///< one per ramp
  std::vector<std::string> wall_from;    ///< one per wall
  std::vector<std::string> lamp_from;    ///< one per lamp
  std::vector<std::string> robot_from;   ///< one per robot
  std::vector<std::vector<Device>> robot_devices;
  std::vector<std::vector<std::string>> robot_parts;
  std::vector<std::string> supervisor_from;
  std::vector<std::vector<Device>> supervisor_devices;
  std::vector<std::string> cosmetic;
};

/// Decides what the floor is and turns every body into objects that our worlds can hold.
/// `floor_z`: where it lies when that is known, and what is found is furniture for a world that has a floor.
Carried settle(const Scene& scene, const Options& options, Report& report,
               std::optional<double> floor_z = {});

/// A place or measure in m as the world file has it: to 0.1 mm.
double as_written(double metres);

/// All of them, and headings, so that checks see what the loader will.
void round_as_written(sim::WorldDesc& world);

/// Moves robots and fixes objects that begin inside something else, so that the world can be loaded. What has
/// no room at all is left out.
void make_room(Carried& c, const Options& options, Report& report);

/// The world file.
std::string write_toml(const Carried& c, const Options& options, const std::vector<Remark>& report,
                       const std::string& version);

}  // namespace wbt
