// SPDX-License-Identifier: MIT
// Named lookup tables of proximity sensors, and the settings of a sensor after inheritance.
// Distances in m, values in counts (0 to 4095). Sources: [FRM A3, B1, B2]; see each table.
#pragma once
#include <string>
#include <vector>

#include "sim_core/geometry/pose.h"
#include "sim_core/world/proximity_desc.h"

namespace sim {

struct WorldDesc;

/// A profile: the table and what goes with it unless a world file says otherwise.
struct ProximityProfile {
  const char* name;
  std::vector<ResponseRow> table;
  int rays;
  double aperture_rad;
  RayLayout layout;
  ColourRule colour_rule;
  NoiseLaw noise_law;
  /// Enki's law: every ray answers by itself and the centre ray makes up for the slant of the others;
  /// otherwise the rays' weighted mean distance goes through the table.
  bool rays_answer_singly;
};

/// All profiles, in the order they are documented.
const std::vector<ProximityProfile>& proximity_profiles();
/// Null when there is none of that name.
const ProximityProfile* find_profile(const std::string& name);

/// The profile of worlds that name none.
inline constexpr const char* kDefaultProfile = "inverse-square";

/// Settings of one sensor with nothing left open.
struct ProximityConfig {
  std::string profile;             ///< its name; empty: the sensor has a table of its own
  std::vector<ResponseRow> table;  ///< sorted by distance, at least two rows
  SensorType type = SensorType::InfraRed;
  int rays = 1;
  int rays_written = 1;  ///< as asked for; an aperture of 0 leaves one
  double aperture_rad = 0;
  double gaussian_width = 1;
  RayLayout layout = RayLayout::Cone;
  ColourRule colour_rule = ColourRule::Old;
  NoiseLaw noise_law = NoiseLaw::Gaussian;
  double noise_scale = 1;
  bool rays_answer_singly = false;
  double max_range_m() const { return table.back().distance_m; }
};

/// Inherits from the sensor's settings, then the robot's, then the world's, then the profile.
ProximityConfig resolve_proximity(const WorldDesc& world, int robot, int sensor);

/// A profile's settings as a sensor has them that nobody edited.
ProximityConfig config_of(const ProximityProfile& profile);

/// One ray of a sensor in the sensor's own frame (x along its axis, y to the left, z up).
struct RayPlan {
  Vec3 dir;           ///< unit
  double weight = 1;  ///< all weights add up to 1
  double off_axis_rad = 0;
  double azimuth_rad = 0;  ///< around the axis: 0 up, growing to the right, seen along the axis
};

/// Where the rays of a sensor go. [Webots] placement for cones (one ray on the axis, further ones on cones up
/// to half the aperture, the first of each cone above the axis); fans spread evenly over the aperture in the
/// plane. A width of 0, or one so small that every weight vanishes, leaves the rays nearest to the axis: the
/// one on it, or, with 2, 3 and 9 rays and even fans, the innermost ones alike.
std::vector<RayPlan> plan_rays(int rays, double aperture_rad, double gaussian_width, RayLayout layout);

/// What is odd about the sensors of a world, a line each, such as rays that do not count. Not errors.
std::vector<std::string> proximity_notices(const WorldDesc& world);

/// Value and relative noise at a distance: linear between rows, clamped beyond the ends.
ResponseRow look_up(const std::vector<ResponseRow>& table, double distance_m);

}  // namespace sim
