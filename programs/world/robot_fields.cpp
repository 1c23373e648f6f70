// SPDX-License-Identifier: MIT
#include "programs/world/robot_fields.h"

#include <fmt/format.h>

#include "hal_sim/host/variables.h"
#include "sim_core/base/hash.h"

namespace programs {

namespace {

std::string behind_colon(const std::string& name) { return name.substr(name.find(':') + 1); }

/// A scalar variable of the robot's firmware; null, and what is wrong.
const host::Variable* scalar_of(const host::Runner* runner, const std::string& expression,
                                std::string& wrong) {
  if (!runner) {
    wrong = "got a robot that runs no firmware, expected one that does";
    return nullptr;
  }
  return runner->data().find_number(expression, wrong);
}

std::string range(const std::string& name, double value, double least, double most, const char* unit) {
  if (value >= least && value <= most) return {};
  return fmt::format("{}: got {}{}, expected {:g} to {:g}", name, value, unit, least, most);
}

}  // namespace

const std::vector<RobotField>& robot_fields() {
  static const std::vector<RobotField> all{
      {"collisions", kInt},          {"longestWallTouch", kFloat},
      {"distance", kFloat},          {"selector", kInt},
      {"batteryVoltage", kFloat},    {"leds", kInt},
      {"proximity", kFloat + kList}, {"leftSteps", kFloat},
      {"rightSteps", kFloat},        {"cpuLoad", kFloat},
      {"traps", kText + kList},      {"proximityNoise", kFloat},
      {"wheelNoise", kFloat},        {"sensor:", kFloat},
      {"variable:", kFloat},
  };
  return all;
}

const RobotField* robot_field(const std::string& name) {
  const std::size_t colon = name.find(':');
  const std::string head = colon == std::string::npos ? name : name.substr(0, colon + 1);
  if (colon != std::string::npos && colon + 1 == name.size()) return nullptr;
  for (const RobotField& f : robot_fields())
    if (head == f.name) return &f;
  return nullptr;
}

std::string get_robot_field(twin::Twin& twin, int robot, const std::string& name,
                            std::vector<double>& numbers, std::vector<std::string>& texts) {
  host::FirmwareMind& mind = twin.mind(robot);
  const sim::Simulation& simulation = twin.simulation();
  const sim::WorldDesc& world = twin.world();
  const sim::RobotDesc& desc = world.robots[static_cast<std::size_t>(robot)];
  numbers.assign(1, 0);
  std::string wrong;
  if (name == "collisions") {
    numbers[0] = simulation.touches(robot).collisions;
  } else if (name == "longestWallTouch") {
    numbers[0] = simulation.touches(robot).longest_wall_touch_s;
  } else if (name == "distance") {
    numbers[0] = simulation.distance_m(robot);
  } else if (name == "selector") {
    numbers[0] = mind.board().selector();
  } else if (name == "batteryVoltage") {
    numbers[0] = mind.board().power().battery().voltage(mind.now());
  } else if (name == "leds") {
    numbers[0] = mind.report().leds;
  } else if (name == "proximity") {
    numbers.clear();
    for (int s = 0; s < board::kRingSensors; ++s)
      numbers.push_back(mind.proximity_counts(simulation.scene(), s));
  } else if (name == "leftSteps") {
    numbers[0] = static_cast<double>(mind.report().left_steps);
  } else if (name == "rightSteps") {
    numbers[0] = static_cast<double>(mind.report().right_steps);
  } else if (name == "cpuLoad") {
    numbers[0] = mind.runner() ? mind.runner()->cpu_load() : 0;
  } else if (name == "traps") {
    numbers.clear();
    if (mind.runner())
      for (const host::TrapReport& t : mind.runner()->traps())
        texts.push_back(fmt::format("{}: {} at {}, {:.6f} s", host::trap_name(t.kind), t.message,
                                    to_string(t.place), t.time_s));
  } else if (name == "proximityNoise") {
    numbers[0] =
        desc.proximity.noise_scale ? *desc.proximity.noise_scale : world.proximity.noise_scale.value_or(1);
  } else if (name == "wheelNoise") {
    numbers[0] = desc.wheels.noise ? *desc.wheels.noise : world.wheels.noise.value_or(0);
  } else if (name.rfind("sensor:", 0) == 0) {
    numbers[0] = mind.board().virtual_devices().get(behind_colon(name)).value_or(0);
  } else if (name.rfind("variable:", 0) == 0) {
    const host::Runner* const runner = mind.runner();
    const host::Variable* v = scalar_of(runner, behind_colon(name), wrong);
    if (!v) return wrong;
    numbers[0] = runner->data().number(*v);
  } else {
    wrong = "no such field";
  }
  return wrong;
}

std::string set_robot_field(twin::Twin& twin, int robot, const std::string& name, double value) {
  host::FirmwareMind& mind = twin.mind(robot);
  sim::Simulation& simulation = twin.simulation();
  host::Runner* const runner = mind.runner();
  std::string wrong;
  if (name == "selector") {
    wrong = range(name, value, 0, 15, "");
    if (wrong.empty()) mind.board().turn_selector(static_cast<int>(value));
  } else if (name == "batteryVoltage") {
    wrong = range(name, value, 3.0, 4.2, " V");
    if (wrong.empty()) mind.board().power().set_voltage(value, mind.now());
  } else if (name == "proximityNoise") {
    wrong = range(name, value, 0, 1000, "");
    if (wrong.empty()) simulation.set_proximity_noise(robot, value);
  } else if (name == "wheelNoise") {
    wrong = range(name, value, 0, 1, "");
    if (wrong.empty()) simulation.set_wheel_noise(robot, value);
  } else if (name.rfind("sensor:", 0) == 0) {
    mind.board().virtual_devices().set(behind_colon(name), value);
  } else if (name.rfind("variable:", 0) == 0) {
    const host::Variable* v = scalar_of(runner, behind_colon(name), wrong);
    if (!v) return wrong;
    runner->data().set_number(*v, value);
  } else {
    wrong = "it can only be read";
  }
  if (!wrong.empty()) return wrong;
  // A program that waits looks again, and the run's digest tells that somebody did this.
  if (runner) runner->wake();
  std::uint64_t h = static_cast<std::uint64_t>(robot) + 1;
  for (const char c : name) h = sim::fold(h, static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  simulation.note_intervention(sim::fold(h, value));
  return {};
}

}  // namespace programs
