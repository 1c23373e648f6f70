// SPDX-License-Identifier: MIT
// What is wrong with robots of a world that only whoever builds them knows: devices that would answer to one
// I2C address, and keys of hardware that a robot has not.
#pragma once
#include <string>
#include <vector>

#include "hal_sim/board/board.h"
#include "sim_core/load/world_loader.h"

namespace twin {

/// What a robot's table says in the keys that only its kind has.
sim::OwnSettings own_settings(const sim::WorldDesc& world, const sim::RobotDesc& robot);

/// Plugs in turrets and the like; returns what is wrong with each.
std::vector<sim::WorldProblem> plug_in_parts(const sim::RobotDesc& robot, board::Board& board);

/// Robots of a kind that is not known are left out.
std::vector<sim::WorldProblem> check_robots(const sim::WorldDesc& world);

}  // namespace twin
