// SPDX-License-Identifier: MIT
// Which driver of the e-puck library owns which timer and interrupt vector, and which pairs cannot
// live in one program.
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cc {

/// One message per timer or vector claimed twice. texts: file name, content; of the program's own files, not
/// of library sources that it brings along. A header in `replaced_headers` counts as the one it stands for.
std::vector<std::string> timer_conflicts(const std::vector<std::pair<std::string, std::string>>& texts,
                                         const std::map<std::string, std::string>& replaced_headers);

}  // namespace cc
