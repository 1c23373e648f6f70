// SPDX-License-Identifier: MIT
#include "programs/world/robot_fields.h"

#include <fmt/format.h>

#include "hal_sim/host/variables.h"
#include "sim_core/base/hash.h"

namespace programs {

namespace {

using What = RobotField::What;

/// A scalar variable of the robot's firmware; null, and what is wrong.
const host::Variable* scalar_of(const host::Runner* runner, const std::string& expression,
                                std::string& wrong) {
  if (!runner) {
    wrong = "got a robot that runs no firmware, expected one that does";
    return nullptr;
  }
  return runner->data().find_number(expression, wrong);
}

std::string range(const char* name, double value, double least, double most, const char* unit) {
  if (value >= least && value <= most) return {};
  return fmt::format("{}: got {}{}, expected {:g} to {:g}", name, value, unit, least, most);
}

}  // namespace

const std::vector<RobotField>& robot_fields() {
  static const std::vector<RobotField> all{
      {What::Collisions, "collisions", kInt},
      {What::LongestWallTouch, "longestWallTouch", kFloat},
      {What::Distance, "distance", kFloat},
      {What::Selector, "selector", kInt},
      {What::BatteryVoltage, "batteryVoltage", kFloat},
      {What::Leds, "leds", kInt},
      {What::Proximity, "proximity", kFloat + kList},
      {What::LeftSteps, "leftSteps", kFloat},
      {What::RightSteps, "rightSteps", kFloat},
      {What::CpuLoad, "cpuLoad", kFloat},
      {What::Traps, "traps", kText + kList},
      {What::ProximityNoise, "proximityNoise", kFloat},
      {What::WheelNoise, "wheelNoise", kFloat},
      {What::Sensor, "sensor:", kFloat},
      {What::Variable, "variable:", kFloat},
  };
  return all;
}

NamedRobotField robot_field(const std::string& name) {
  const std::size_t colon = name.find(':');
  const std::string head = colon == std::string::npos ? name : name.substr(0, colon + 1);
  const std::string words = colon == std::string::npos ? "" : name.substr(colon + 1);
  if (colon != std::string::npos && words.empty()) return {};
  for (const RobotField& f : robot_fields())
    if (head == f.name) return {&f, words};
  return {};
}

std::string get_robot_field(twin::Twin& twin, int robot, const NamedRobotField& asked,
                            std::vector<double>& numbers, std::vector<std::string>& texts) {
  host::FirmwareMind& mind = twin.mind(robot);
  const sim::Simulation& simulation = twin.simulation();
  const sim::WorldDesc& world = twin.world();
  const sim::RobotDesc& desc = world.robots[static_cast<std::size_t>(robot)];
  numbers.assign(1, 0);
  std::string wrong;
  switch (asked.field->what) {
    case What::Collisions:
      numbers[0] = simulation.touches(robot).collisions;
      break;
    case What::LongestWallTouch:
      numbers[0] = simulation.touches(robot).longest_wall_touch_s;
      break;
    case What::Distance:
      numbers[0] = simulation.distance_m(robot);
      break;
    case What::Selector:
      numbers[0] = mind.board().selector();
      break;
    case What::BatteryVoltage:
      numbers[0] = mind.board().power().battery().voltage(mind.now());
      break;
    case What::Leds:
      numbers[0] = mind.report().leds;
      break;
    case What::Proximity:
      numbers.clear();
      for (int s = 0; s < board::kRingSensors; ++s)
        numbers.push_back(mind.proximity_counts(simulation.scene(), s));
      break;
    case What::LeftSteps:
      numbers[0] = static_cast<double>(mind.report().left_steps);
      break;
    case What::RightSteps:
      numbers[0] = static_cast<double>(mind.report().right_steps);
      break;
    case What::CpuLoad:
      numbers[0] = mind.runner() ? mind.runner()->cpu_load() : 0;
      break;
    case What::Traps:
      numbers.clear();
      if (mind.runner())
        for (const host::TrapReport& t : mind.runner()->traps())
          texts.push_back(fmt::format("{}: {} at {}, {:.6f} s", host::trap_name(t.kind), t.message,
                                      to_string(t.place), t.time_s));
      break;
    case What::ProximityNoise:
      numbers[0] =
          desc.proximity.noise_scale ? *desc.proximity.noise_scale : world.proximity.noise_scale.value_or(1);
      break;
    case What::WheelNoise:
      numbers[0] = desc.wheels.noise ? *desc.wheels.noise : world.wheels.noise.value_or(0);
      break;
    case What::Sensor:
      numbers[0] = mind.board().virtual_devices().get(asked.words).value_or(0);
      break;
    case What::Variable:
      if (const host::Variable* const v = scalar_of(mind.runner(), asked.words, wrong))
        numbers[0] = mind.runner()->data().number(*v);
      break;
  }
  return wrong;
}

std::string set_robot_field(twin::Twin& twin, int robot, const NamedRobotField& asked, double value) {
  host::FirmwareMind& mind = twin.mind(robot);
  sim::Simulation& simulation = twin.simulation();
  host::Runner* const runner = mind.runner();
  const char* const name = asked.field->name;
  std::string wrong;
  switch (asked.field->what) {
    case What::Selector:
      wrong = range(name, value, 0, 15, "");
      if (wrong.empty()) mind.board().turn_selector(static_cast<int>(value));
      break;
    case What::BatteryVoltage:
      wrong = range(name, value, 3.0, 4.2, " V");
      if (wrong.empty()) mind.board().power().set_voltage(value, mind.now());
      break;
    case What::ProximityNoise:
      wrong = range(name, value, 0, 1000, "");
      if (wrong.empty()) simulation.set_proximity_noise(robot, value);
      break;
    case What::WheelNoise:
      wrong = range(name, value, 0, 1, "");
      if (wrong.empty()) simulation.set_wheel_noise(robot, value);
      break;
    case What::Sensor:
      mind.board().virtual_devices().set(asked.words, value);
      break;
    case What::Variable:
      if (const host::Variable* const v = scalar_of(runner, asked.words, wrong))
        runner->data().set_number(*v, value);
      break;
    default:
      wrong = "it can only be read";
  }
  if (!wrong.empty()) return wrong;
  // A program that waits looks again, and the run's digest tells that somebody did this.
  if (runner) runner->wake();
  std::uint64_t h = static_cast<std::uint64_t>(robot) + 1;
  const auto fold = [&](char c) {
    h = sim::fold(h, static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  };
  for (const char* c = name; *c != 0; ++c) fold(*c);
  for (const char c : asked.words) fold(c);
  simulation.note_intervention(sim::fold(h, value));
  return {};
}

}  // namespace programs
