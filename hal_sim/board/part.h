// SPDX-License-Identifier: MIT
// A part: something plugged into the robot's connectors, such as a turret or a sensor board. One C++ file
// each in hal_sim/board/parts/; docs/extending.md shows how to add one.
//
//   [[robot.part]] kind = "..."  ->  PartType of that file  ->  Part, hung on I2C, analogue inputs and pins
//
// In: the instant (a cycle of the robot) at which something is asked. Out: bytes, volts. A part sees
// the world through board().scene() as it was frozen at the last tick, and nothing else. It answers
// for the instant it is asked about and does no work in between; random numbers come from random().
// Nothing here blocks.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/board/cycle.h"
#include "sim_core/random/counter_random.h"
#include "sim_core/world/part_desc.h"
#include "sim_core/world/robot_model.h"  // points and poses

namespace board {

class Board;

/// What the world file says of one part, defaults filled in.
class PartSettings : public sim::OwnSettings {
 public:
  /// `number`: which of its robot's parts it is, from 0; keeps two of a kind apart in their noise.
  PartSettings(const sim::PartKind& kind, const sim::PartDesc& desc, int number)
      : OwnSettings(kind.keys, desc.values), kind_(&kind), part_number_(number) {}

  const std::string& kind() const { return kind_->name; }
  int part_number() const { return part_number_; }

 private:
  const sim::PartKind* kind_;  // lives as long as the program
  int part_number_;
};

class Part {
 public:
  explicit Part(const PartSettings& settings) : settings_(settings) {}
  virtual ~Part() = default;
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  const PartSettings& settings() const { return settings_; }

  /// Called once, before power-up: the place to hang devices on board().i2c().
  virtual void connect() {}

  /// Voltage the part puts on the analogue input AN`channel` at `at`, V; empty: it leaves that input alone.
  virtual std::optional<double> analogue_v(int /*channel*/, Cycle /*at*/) const { return std::nullopt; }

  /// The processor wrote to a port at `at`: the place to note when a pin changed. Levels:
  /// board().pins().read().
  virtual void pins_changed(Cycle /*at*/) {}

  /// The processor was reset. Parts have power of their own, so the default does nothing.
  virtual void processor_reset(Cycle /*at*/) {}

  /// Everything of its own that must repeat from run to run.
  virtual std::uint64_t state_hash() const { return 0; }

  /// What somebody looking at it would see, a few words; empty: nothing.
  virtual std::string shows(Cycle /*at*/) const { return {}; }

 protected:
  Board& board() const { return *board_; }
  /// Pose of the robot at `at` in the frozen scene. Without a scene, all 0.
  sim::Pose2 pose(Cycle at) const;
  /// World coordinates of a point of the robot (x forward, y left), m.
  sim::Vec2 to_world(sim::Vec2 point_m, Cycle at) const;
  /// Cycles since the robot began, for the first time or again: what samples are numbered by.
  Cycle since_begin(Cycle at) const;
  /// Key of one of this part's noises, `stream` 0 to 15; draw with a number that is the sample's own.
  sim::RandomKey random(int stream) const;

 private:
  friend class Board;
  PartSettings settings_;
  Board* board_ = nullptr;
};

/// A kind and how one is made: what each file in parts/ offers, under the name part_<file>().
struct PartType {
  sim::PartKind kind;
  std::unique_ptr<Part> (*make)(const PartSettings& settings);
};

/// All kinds, in the order of their file names. The table is written by CMake from the files in the folder.
const std::vector<const PartType*>& part_types();
/// Null when there is none of that name.
const PartType* find_part_type(const std::string& kind);
/// What the loader wants to know.
std::vector<sim::PartKind> part_kinds();

/// A `make` for any class with a constructor that takes PartSettings.
template <typename T>
std::unique_ptr<Part> make_part(const PartSettings& settings) {
  return std::make_unique<T>(settings);
}

}  // namespace board
