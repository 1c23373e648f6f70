// SPDX-License-Identifier: MIT
// Which driver of the e-puck library owns which timer, and which pairs cannot live in one program.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace cc {

/// One message per timer claimed twice. texts: file name, content.
std::vector<std::string> timer_conflicts(const std::vector<std::pair<std::string, std::string>>& texts);

}  // namespace cc
