// SPDX-License-Identifier: MIT
// Reads a PNG (by cairo) as the picture on an arena's floor.
#pragma once
#include <string>

#include "sim_core/world/world_desc.h"

namespace sim {

/// Fills the floor's pixels. Returns an empty string, or "got ..., expected ..." when the file is no good.
std::string read_floor_image(const std::string& path, FloorDesc& floor);

}  // namespace sim
