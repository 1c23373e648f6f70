// SPDX-License-Identifier: MIT
// Parts that may be plugged into a robot (turrets, sensor boards), as pure data: which kinds there are, which
// keys each takes in a world file, and what a robot's file says of its own. Whoever knows real parts hands
// their kinds to the loader, as it hands the robot models; sim_core itself names none.
#pragma once
#include "sim_core/world/own_keys.h"

namespace sim {

struct PartKind {
  std::string name;  ///< what world files write in `kind`
  std::string doc;   ///< a sentence
  std::vector<OwnKey> keys;
};

/// A part of one robot: its kind and the keys that were written.
struct PartDesc {
  std::string kind;
  OwnValues values;
  int line = 0;  ///< line in the world file; 0 when built in C++
  int column = 0;
};

}  // namespace sim
