// SPDX-License-Identifier: MIT
// What one particular robot is after its random spread has been drawn: plain numbers for boards and physics.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace sim {

struct WorldDesc;

struct ResolvedVariation {
  std::uint64_t seed = 0;                    ///< the robot's own; all its noise is keyed by it
  std::vector<double> sensor_gain;           ///< one per proximity sensor
  std::vector<double> sensor_offset_counts;  ///< one per proximity sensor
  double left_wheel_ratio = 1;
  double right_wheel_ratio = 1;
  double axle_ratio = 1;
  double clock_ppm = 0;
  double boot_delay_s = 0;
  std::array<double, 3> acc_offset_m_s2{};    ///< robot frame: forward, left, up
  std::array<double, 3> gyro_offset_rad_s{};  ///< same frame
};

/// The robot's seed: its own where set, otherwise a mix of the world's seed and its index.
std::uint64_t robot_seed(const WorldDesc& world, int robot);

/// Draws the spread: a pure function of the robot's seed.
ResolvedVariation resolve_variation(const WorldDesc& world, int robot);

}  // namespace sim
