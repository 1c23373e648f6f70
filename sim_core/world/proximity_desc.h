// SPDX-License-Identifier: MIT
// Proximity sensors as a world file says them: of the world, of a robot, of one sensor.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace sim {

enum class RayLayout { Cone, Fan };  ///< spread on cones (Webots) or side by side in the plane (Enki)
enum class SensorType { InfraRed, Generic };  ///< with or without a colour rule
enum class ColourRule { Old, New, None };
enum class NoiseLaw { Uniform, Gaussian };

/// One row of a lookup table.
struct ResponseRow {
  double distance_m = 0;
  double value = 0;           ///< counts
  double relative_noise = 0;  ///< fraction of value
};

/// Proximity settings as written: what is not set is inherited (sensor from robot from world from the
/// profile).
struct ProximitySettings {
  std::optional<std::string> profile;             ///< webots-old, webots-new, inverse-square, enki, argos
  std::optional<std::vector<ResponseRow>> table;  ///< own rows, instead of the profile's
  std::optional<SensorType> type;
  std::optional<int> rays;
  std::optional<double> aperture_rad;
  std::optional<double> gaussian_width;
  std::optional<RayLayout> layout;
  std::optional<ColourRule> colour_rule;
  std::optional<NoiseLaw> noise_law;
  std::optional<double> noise_scale;  ///< factor on the table's relative noise; 0 = none

  /// True when nothing is set.
  bool is_empty() const {
    return !profile && !table && !type && !rays && !aperture_rad && !gaussian_width && !layout &&
           !colour_rule && !noise_law && !noise_scale;
  }
};

/// Settings of single sensors.
struct SensorDesc {
  int index = 0;
  ProximitySettings proximity;
};

}  // namespace sim
