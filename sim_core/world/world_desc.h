// SPDX-License-Identifier: MIT
// A world as pure data: what a world file says, in SI units and radians, ready to be built. Made by load/, or
// in a few lines of C++. Every field's key, unit, range and default stand once, in load/schema_*.cpp and
// docs/worlds.md.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim_core/world/device_desc.h"
#include "sim_core/world/part_desc.h"
#include "sim_core/world/proximity_desc.h"
#include "sim_core/world/radio_desc.h"
#include "sim_core/world/robot_desc.h"
#include "sim_core/world/robot_model.h"
#include "sim_core/world/sound_desc.h"
#include "sim_core/world/things_desc.h"

namespace sim {

enum class Engine { Dynamic, Kinematic, Planar };

/// Words between blanks; a word in "" or '' may hold blanks.
std::vector<std::string> argument_words(const std::string& args);

/// A program attached to the world.
struct SupervisorDesc {
  std::string name;
  std::string program;              ///< name or path as written
  FilePlace program_at;             ///< where that is written
  std::string args;                 ///< what its main() gets, words as argument_words() has them
  std::string def;                  ///< second name, by which supervisors may look it up; may be empty
  std::string custom_data;          ///< a text that programs may read and change
  std::vector<DeviceDesc> devices;  ///< of its own
  int node = 0;                     ///< line of its node in WebotsDesc::world; 0: none
  int line = 0;
};

struct WorldDesc {
  std::string title;
  std::string file;  ///< where it was read from; empty when built in C++
  int physics_hz = 512;
  Engine engine = Engine::Dynamic;
  double gravity_m_s2 = 9.81;
  std::uint64_t seed = 1;
  double ambient_w_m2 = 0;
  std::optional<ArenaDesc> arena;
  FloorDesc floor;
  SkyDesc sky;
  std::vector<Material> materials;
  std::vector<WallDesc> walls;
  std::vector<ObjectDesc> objects;
  std::vector<RampDesc> ramps;
  std::vector<LampDesc> lamps;
  std::vector<SoundDesc> sounds;
  ProximitySettings proximity;
  WheelSettings wheels;
  RadioDesc radio;
  LinkDesc link;
  std::vector<RobotDesc> robots;
  WebotsDesc webots;
  std::vector<SupervisorDesc> supervisors;
  std::vector<RobotModel> models;    ///< what the caller offers; robots refer to them by name
  std::vector<PartKind> part_kinds;  ///< likewise, for robots' parts

  /// The model of a robot; null when there is none of that name.
  const RobotModel* model_of(const RobotDesc& robot) const {
    if (robot.model.empty()) return models.empty() ? nullptr : &models.front();
    for (const RobotModel& m : models) {
      if (m.name == robot.model) return &m;
    }
    return nullptr;
  }
};

}  // namespace sim
