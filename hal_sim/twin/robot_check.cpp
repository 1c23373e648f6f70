// SPDX-License-Identifier: MIT
#include "hal_sim/twin/robot_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hal_sim/board/epuck_model.h"
#include "hal_sim/board/part.h"

namespace twin {
namespace {

/// First address at which a device that came later than `before` others answers like one of them, -1: none.
int shared_address(const board::I2cBus& bus, std::size_t before) {
  const auto& all = bus.devices();
  for (int address = 0; address < 256; address += 2) {
    const auto answers = [&](const board::I2cDevice* device) {
      return device->answers_to(static_cast<std::uint8_t>(address));
    };
    const auto fresh = all.begin() + static_cast<std::ptrdiff_t>(before);
    if (std::any_of(all.begin(), fresh, answers) && std::any_of(fresh, all.end(), answers)) return address;
  }
  return -1;
}

/// What decides which devices a robot has, and where they answer.
std::string hardware_of(const sim::RobotDesc& robot, const sim::OwnSettings& own) {
  std::string text = own.text("revision") + own.text("camera");
  for (const sim::PartDesc& part : robot.parts) {
    text += "\n" + part.kind;
    for (const auto& [key, value] : part.values) {
      text += " " + key + value.text;
      for (const double n : value.numbers) text += fmt::format(" {}", n);
    }
  }
  return text;
}

}  // namespace

sim::OwnSettings own_settings(const sim::WorldDesc& world, const sim::RobotDesc& robot) {
  return {world.model_of(robot)->keys, robot.own};
}

std::vector<sim::WorldProblem> plug_in_parts(const sim::RobotDesc& robot, board::Board& board) {
  std::vector<sim::WorldProblem> out;
  for (std::size_t i = 0; i < robot.parts.size(); ++i) {
    const sim::PartDesc& part = robot.parts[i];
    const board::PartType* type = board::find_part_type(part.kind);
    if (!type) {
      out.push_back({part.line, part.column,
                     fmt::format("robot '{}': part: got kind '{}', expected one that the program knows",
                                 robot.name, part.kind)});
      continue;
    }
    const std::size_t before = board.i2c().devices().size();
    board.plug_in(type->make(board::PartSettings(type->kind, part, static_cast<int>(i))));
    const int address = shared_address(board.i2c(), before);
    if (address >= 0)
      out.push_back({part.line, part.column,
                     fmt::format("robot '{}': part '{}': got I2C address 0x{:02X}, which another device of "
                                 "this robot has, expected one of its own; leave one of them out",
                                 robot.name, part.kind, address)});
  }
  return out;
}

std::vector<sim::WorldProblem> check_robots(const sim::WorldDesc& world) {
  std::vector<sim::WorldProblem> out;
  std::map<std::string, bool> is_good;  // of hardware that several robots may have
  for (const sim::RobotDesc& robot : world.robots) {
    if (!world.model_of(robot)) continue;
    const sim::OwnSettings own = own_settings(world, robot);
    const sim::Variation& v = robot.variation;
    const auto gyro = [&](const char* key, bool is_written) {
      if (is_written && own.text("revision") == "1.1")
        out.push_back({robot.line, 1,
                       fmt::format("robot.variation.{}: got one where 'revision' is 1.1, which has no "
                                   "gyroscope, expected one only where it is 1.3",
                                   key)});
    };
    gyro("gyro_offset", v.gyro_offset_rad_s != std::array<double, 3>{});
    gyro("gyro_offset_spread", v.gyro_offset_spread_rad_s > 0);
    if (robot.parts.empty()) continue;
    const auto [known, is_new] = is_good.try_emplace(hardware_of(robot, own), true);
    if (!is_new && known->second) continue;
    board::Setup setup;
    board::set_up(setup, own);
    board::Board board(setup);
    const std::vector<sim::WorldProblem> wrong = plug_in_parts(robot, board);
    known->second = wrong.empty();
    out.insert(out.end(), wrong.begin(), wrong.end());
  }
  return out;
}

}  // namespace twin
