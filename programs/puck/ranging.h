// SPDX-License-Identifier: MIT
// What an e-puck's [[robot.device]] that measure distances see: distance sensors with a table, lidars, range
// finders. Rays in the scene at one instant, without noise. Pure functions; any thread.
#pragma once
#include <vector>

#include "sim_core/world/device_desc.h"
#include "sim_core/world/most_ranges.h"
#include "sim_core/world/scene.h"

namespace programs {

/// m, `height` rows from the top, each of `width` columns from the left to the right, at most sim::kMostRanges:
/// of a lidar along the ray, of a range finder along its line of sight. Infinite: nothing from `near_m` to
/// `far_m`.
std::vector<double> ranges(const sim::Scene& scene, int robot, const sim::DeviceDesc& device, sim::Clicks at);

/// What a distance sensor's table makes of the mean distance over its rays.
double measured_distance(const sim::Scene& scene, int robot, const sim::DeviceDesc& device, sim::Clicks at);

/// The value of a table at a distance, m: linear in between, the ends' beyond them. Two rows or more.
double looked_up(const std::vector<sim::ResponseRow>& table, double distance_m);

}  // namespace programs
