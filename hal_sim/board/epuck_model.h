// SPDX-License-Identifier: MIT
// The e-puck's body, wheels and sensor places, as the world sees them.
#pragma once
#include "sim_core/world/robot_model.h"

namespace board {

/// Model "e-puck" for world files; numbers in epuck_params.h.
sim::RobotModel epuck_model();

}  // namespace board
