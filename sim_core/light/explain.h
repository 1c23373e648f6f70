// SPDX-License-Identifier: MIT
// One reading of a proximity or light sensor taken apart, for people: what each ray met, how the rays became
// a distance, which rows of the table answered; what each lamp gives. The numbers are those of
// sense_proximity() and sense_irradiance_w_m2() at the same instant, before the board's gain, offset and
// noise. In: a frozen Scene. Out: SI, angles in radians. Allocates; not for the tick.
#pragma once
#include <string>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/light/proximity.h"
#include "sim_core/world/layout.h"

namespace sim {

/// What a ray met, in words and as a surface.
struct Met {
  std::string name;  ///< "arena wall 2", "box 'crate'", "robot 'a'", "the floor", "ramp 1"; empty: nothing
  Surface surface;
  double bottom_m = 0;  ///< height range of a solid, world frame
  double top_m = 0;
};

struct RayExplanation {
  RayTrace trace;           ///< from, to, distance, colour factor, weight
  Vec3 dir;                 ///< unit, world frame
  double azimuth_rad = 0;   ///< around the sensor's axis: 0 up, growing to the right
  double off_axis_rad = 0;  ///< from the sensor's axis
  double bearing_rad = 0;   ///< in plan from the robot's nose, counter-clockwise, -pi to pi
  double rise_rad = 0;      ///< above the horizontal
  Met met;
  double apparent_m = 0;     ///< distance / factor: where the surface seems to be
  double answer_counts = 0;  ///< where rays answer singly: this ray's part of the value
};

/// Which part of a lookup table answered.
struct TableStep {
  int row = 0;           ///< index of the row at or below the distance
  bool clamped = false;  ///< the distance lies beyond an end: that row alone answered
  ResponseRow from, to;  ///< the two rows; equal when clamped
  double fraction = 0;   ///< of the way from `from` to `to`
  ResponseRow result;    ///< interpolated
};
TableStep table_step(const std::vector<ResponseRow>& table, double distance_m);

struct ProximityExplanation {
  ProximityConfig config;
  Vec3 at_m;               ///< the sensor, world frame
  double bearing_rad = 0;  ///< of its axis from the robot's nose, counter-clockwise
  std::vector<RayExplanation> rays;
  double distance_m = 0;  ///< weighted mean of the rays' distances
  double factor = 1;      ///< weighted mean of their colour factors
  TableStep step;         ///< at the apparent distance
  ProximityResponse response;
};
ProximityExplanation explain_proximity(const Scene& scene, int robot, int sensor, Clicks at);

struct LampExplanation {
  std::string name;  ///< as written, or "lamp 2"
  LampShare share;
  std::string blocked_by;  ///< empty: nothing
};
struct LightExplanation {
  double ambient_w_m2 = 0;
  std::vector<LampExplanation> lamps;
  double total_w_m2 = 0;
};
LightExplanation explain_light(const Scene& scene, int robot, int sensor, Clicks at);

}  // namespace sim
