// SPDX-License-Identifier: MIT
// The e-puck's body, wheels and sensor places, as the world sees them, and what a world file may say
// of an e-puck alone.
#pragma once
#include "hal_sim/board/setup.h"
#include "sim_core/world/robot_model.h"

namespace board {

/// Model "e-puck" for world files, with the board's keys; numbers in epuck_params.h.
sim::RobotModel epuck_model();

/// What these keys say of one robot.
void set_up(Setup& setup, const sim::OwnSettings& own);

}  // namespace board
