// SPDX-License-Identifier: MIT
// Functions of Webots' interfaces that an e-puck cannot serve: what it lacks, and what to do instead.
#pragma once
#include <string>

namespace cc {

/// "an e-puck has no GPS; count the steps of its wheels with a position sensor"; empty for
/// any other function.
std::string what_the_robot_lacks(const std::string& function);

}  // namespace cc
