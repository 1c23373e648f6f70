// SPDX-License-Identifier: MIT
// How much a lidar or range finder may see at once.
#pragma once

namespace sim {

/// Most distances of one sample, columns times rows: what a packet to a program holds.
inline constexpr int kMostRanges = 12000;

}  // namespace sim
