// SPDX-License-Identifier: MIT
// What is wrong, said on the terminal.
#pragma once
#include <iostream>
#include <string>
#include <vector>

namespace outputs {

/// Writes each problem on a line of its own to stderr.
inline void complain(const std::vector<std::string>& problems) {
  for (const auto& p : problems) std::cerr << p << '\n';
}

}  // namespace outputs
