// SPDX-License-Identifier: MIT
// Where in a world file something stands.
#pragma once

namespace sim {

struct FilePlace {
  int line = 0;    ///< from 1; 0: in none, such as a world built in C++
  int column = 0;  ///< from 1
};

}  // namespace sim
