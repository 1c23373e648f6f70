// SPDX-License-Identifier: MIT
// `--key ROBOT=[ADDRESS:]KEY@TIME[+HOLD]`: key presses of a remote control from the command line; with
// `keyboard:` before the key those of a keyboard, which programs for Webots' interfaces ask for.
#pragma once
#include <string>
#include <vector>

#include "sim_core/world/robot_desc.h"

namespace tools {

/// Adds a press to the robots of that name ('*': all), and says when it comes. Returns what is wrong as "got ...,
/// expected ...", or an empty string.
std::string add_key(const std::string& robot, const std::string& press, std::vector<sim::RobotDesc>& robots,
                    double& at_s);

}  // namespace tools
