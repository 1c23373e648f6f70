// SPDX-License-Identifier: MIT
// A device of the world file as programs are told of it: robots' and supervisors' alike, but for what either has
// of its own.
#pragma once
#include <vector>

#include "sim_core/world/device_desc.h"

namespace programs {

struct WorldDevice {
  int node;                   ///< WbNodeType
  std::vector<double> needs;  ///< what a program has to know of it (put_device())
};

WorldDevice world_device(const sim::DeviceDesc& d);

}  // namespace programs
