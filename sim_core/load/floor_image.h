// SPDX-License-Identifier: MIT
// Reads a PNG (by cairo) as the picture on an arena's floor.
#pragma once
#include <string>
#include <string_view>

#include "sim_core/world/things_desc.h"

namespace sim {

/// Fills the floor's pixels. Returns an empty string, or "got ..., expected ..." when the file is no good.
std::string read_floor_image(const std::string& path, FloorDesc& floor);

/// The same from the bytes of a file; what is wrong without "got" and "expected".
std::string parse_floor_image(std::string_view bytes, FloorDesc& floor);

}  // namespace sim
