// SPDX-License-Identifier: MIT
// The shape of what bodies stand on: a plane with ramps on it, and the way gravity points over it.
//
// Coordinates are those of the floor's own plane, so a floor that is tilted as a whole is only a gravity that
// pulls sideways. A ramp is a rectangle in plan whose height grows evenly from its low to its high end along
// its heading; equal ends make a platform. Where ramps overlap the highest counts. Metres, radians.
// Not modelled: curved ground, ground that moves.
#pragma once
#include <vector>

#include "sim_core/geometry/pose.h"
#include "sim_core/geometry/solid.h"

namespace sim {

struct Ramp {
  Pose2 pose;             ///< of its middle; heading uphill
  double length_m = 0.2;  ///< in plan, along the heading
  double width_m = 0.2;   ///< across
  double low_m = 0;       ///< height of the low end above the floor
  double high_m = 0;      ///< height of the high end
};

/// Ground under a body that rests on it, as a plane.
struct Footing {
  double height_m = 0;  ///< above the floor, under the body's origin
  Vec2 slope;           ///< gradient of the height in plan, world frame
};

class Ground {
 public:
  Ground() = default;
  /// tilt_*_rad: angle by which the floor's x and y axes rise above the horizontal; each within 40 degrees.
  Ground(const std::vector<Ramp>& ramps, double tilt_x_rad, double tilt_y_rad);

  bool has_ramps() const { return !parts_.empty(); }
  /// Level and without ramps: nobody needs to ask for anything.
  bool is_plain() const { return parts_.empty() && down_.z == -1; }
  /// Unit vector of gravity in the floor's frame.
  const Vec3& down() const { return down_; }

  double height_m(Vec2 at) const;
  /// The plane through the ground under a body: heights before and behind it (half_length_m away) give the
  /// slope along its heading, heights at its sides (half_width_m away) the slope across and the height.
  Footing footing(const Pose2& pose, double half_length_m, double half_width_m) const;
  /// No kerb lies under the body: nothing between its middle and the footing's four places is steeper than the
  /// ramps there.
  bool is_smooth(const Pose2& pose, double half_length_m, double half_width_m) const;
  /// Index of the ramp that a ray from above meets nearer than distance_m, which then becomes the distance;
  /// -1: none. The floor itself is the caller's.
  int cast(const Ray& ray, double& distance_m, Vec3* normal = nullptr) const;

 private:
  struct Part {
    Frame2 frame;
    double half_length_m, half_width_m, reach_m;
    double middle_m, rise;  // height in the middle; height per metre along the heading
  };
  std::vector<Part> parts_;
  Vec3 down_{0, 0, -1};
};

/// Axes of a body that stands on a slope, as unit vectors in the floor's frame: x forward, y left, z up.
struct BodyAxes {
  Vec3 forward{1, 0, 0};
  Vec3 left{0, 1, 0};
  Vec3 up{0, 0, 1};
};
BodyAxes axes_on(Vec2 slope, double heading_rad);

constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// What a slope does to a body that drives on it, seen in plan.
struct SlopeEffect {
  double way = 1;    ///< plan way of a unit of way along the heading
  double turn = 1;   ///< turn in plan of a unit of turn about the body's own axis
  double press = 1;  ///< force on the floor over weight
  Vec2 uphill;       ///< unit vector in plan; zero on the level
  double steep = 1;  ///< cosine of the slope's angle
  Vec2 pull;         ///< acceleration by gravity without friction, plan, as a part of g
};
SlopeEffect slope_effect(Vec2 slope, double heading_rad, const Vec3& down);

/// The velocity in plan behind a bend of the ground from one slope to another: the speed along the surface
/// stays, the change is along the mean of both slopes, as the bend's push is.
Vec2 behind_bend(Vec2 plan, Vec2 before, Vec2 after);

/// Length along the surface of a vector that is given in plan.
double surface_length(const SlopeEffect& slope, Vec2 plan);

}  // namespace sim
