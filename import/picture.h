// SPDX-License-Identifier: MIT
// The average colour of a picture file.
#pragma once
#include <optional>
#include <string>

#include "sim_core/world/robot_model.h"

namespace wbt {

/// Of a PNG or JPEG file; nothing when it cannot be read.
std::optional<sim::Colour> average_colour(const std::string& file);
/// The same from the bytes of a file.
std::optional<sim::Colour> average_colour_of(const std::string& bytes);

}  // namespace wbt
