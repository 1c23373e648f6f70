// SPDX-License-Identifier: MIT
// Writes pixels as a PNG file (by cairo).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sim {

/// `rgb`: rows from the top, three bytes a pixel, 3 * width * height of them. Returns an empty string, or
/// what went wrong in one line.
std::string write_png(const std::string& path, int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace sim
