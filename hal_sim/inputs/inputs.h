// SPDX-License-Identifier: MIT
// What somebody outside does to a running world: moves things, types, turns selectors, changes the furniture.
// An input is a JSON object with the key "do"; docs/connecting.md lists them. Applied between ticks, each
// becomes part of the history that the digest sees. recording.h writes them down.
#pragma once
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal_sim/faults/injector.h"
#include "hal_sim/twin/twin.h"

namespace inputs {

using Json = nlohmann::json;

/// To which a battery can be charged, V.
inline constexpr double kLeastBatteryV = 3.0, kMostBatteryV = 4.2;

class TypedLine;

class Inputs {
 public:
  explicit Inputs(twin::Twin& twin) : twin_(twin), faults_(twin) {}
  ~Inputs();
  /// Does it; throws std::runtime_error that says what is wrong, "got ..., expected ...", when nothing was
  /// done. Json's own exceptions pass: a member is missing or of another type.
  void apply(const Json& input);
  /// A "world", for whoever has parsed its text already.
  void refurnish(const Json& input, sim::WorldDesc world);
  /// Those that inputs have asked for, and others'. Whoever steps the twin steps by its
  /// advance(), or by step().
  faults::Injector& faults() { return faults_; }
  /// One tick, with the faults that are due before and behind it.
  void step();

 private:
  struct Kind;
  static const std::vector<Kind>& kinds();
  // to the world
  void refurnish(const Json& input);
  void flash(const Json& input);
  void move(const Json& input);
  void add_faults(const Json& input);
  void end_fault(const Json& input);
  void set_lamp(const Json& input);
  // to a robot
  void set_sensor(const Json& input, int robot);
  void turn_selector(const Json& input, int robot);
  void set_battery(const Json& input, int robot);
  void type(const Json& input, int robot);
  void press_key(const Json& input, int robot);
  void restart(const Json& input, int robot);
  void set_variable(const Json& input, int robot);
  void write_memory(const Json& input, int robot);
  int robot_of(const Json& input) const;
  host::Runner& program_of(const Json& input, int robot);
  TypedLine& line(int robot, int port);

  twin::Twin& twin_;
  faults::Injector faults_;
  std::map<int, std::shared_ptr<TypedLine>> lines_;  // [robot * 2 + port - 1]
};

}  // namespace inputs
