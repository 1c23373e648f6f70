// SPDX-License-Identifier: MIT
// What pages plot and inspectors show of a robot, by the names that pages have for it (hal_sim/signals).
//
//   puck.x puck.heading puck.ir3 puck.light3 puck.acc_x puck.mic0 puck.led4 puck.left_steps puck.selector
//   puck.battery puck.load puck.collisions puck.pin:D3 puck.reg:T2CON puck.var:speed[1]
#pragma once
#include <string>
#include <vector>

#include "hal_sim/signals/signals.h"

namespace viewer {

using signals::Named;

/// Throws std::runtime_error, "got ..., expected ...", for a name that nothing has.
Named find_named(twin::Twin& twin, const std::string& name);

/// Names that every robot has, without the robot's, for lists to choose from.
std::vector<std::string> names_of_robots();

}  // namespace viewer
