// SPDX-License-Identifier: MIT
// The shapes a world is made of: upright convex prisms, upright cylinders and balls, each in its own
// frame with a height range; and what a ray, a disc or a neighbour asks of them. Metres. Not
// modelled: tilted bodies.
#pragma once
#include <vector>

#include "sim_core/geometry/pose.h"

namespace sim {

/// n . p <= offset holds inside; n is a unit vector pointing out.
struct HalfPlane {
  Vec2 normal;
  double offset_m = 0;
};

enum class SolidKind { Prism, Cylinder, Ball };

/// One convex upright shape in its body's frame.
struct Solid {
  SolidKind kind = SolidKind::Cylinder;
  std::vector<Vec2> outline;     ///< prism: corners, counter-clockwise
  std::vector<HalfPlane> sides;  ///< prism: the same as half planes
  Vec2 half_m;                   ///< box around the origin: half its sizes; 0, 0: no such box
  double radius_m = 0;           ///< cylinder and ball
  double z0_m = 0;               ///< bottom above the body's own z
  double z1_m = 0;               ///< top above the body's own z
  double bound_m = 0;  ///< radius of the vertical cylinder around the body's origin that holds it all

  static Solid prism(std::vector<Vec2> counter_clockwise, double z0_m, double z1_m);
  static Solid box(double size_x_m, double size_y_m, double z0_m, double z1_m);
  static Solid cylinder(double radius_m, double z0_m, double z1_m);
  /// Rests on the body's z: its centre is one radius above.
  static Solid ball(double radius_m);

  bool is_box() const { return half_m.x > 0; }
  /// Second moment about the vertical axis through the origin, divided by the mass, m2.
  double gyration_m2() const;
};

/// Corners in counter-clockwise order, whatever order they came in.
std::vector<Vec2> counter_clockwise(std::vector<Vec2> corners);
/// True when the corners, in order, go round a convex shape of at least 1 mm2.
bool is_convex(const std::vector<Vec2>& corners);

/// A solid at its place in the world.
struct Placed {
  const Solid* solid = nullptr;
  Frame2 frame;
  double z_m = 0;  ///< height of the body's origin above the floor
};
/// One at a pose: what is round looks the same whichever way it has turned, and needs no sine.
Placed placed_at(const Solid& solid, const Pose2& pose, double z_m);

/// A ray in space; `dir` has length 1, so distances along it are metres.
struct Ray {
  Vec3 from;
  Vec3 dir;
};

/// True when the ray meets the solid nearer than `distance_m`, which then becomes the distance of the
/// first meeting; `normal`, if given, the unit vector out of the surface there. A ray that starts inside
/// hits at distance 0.
bool cast_ray(const Ray& ray, const Placed& what, double& distance_m, Vec3* normal = nullptr);

/// Where a ray of a fan ends, and what the caller has said of the solid that it meets there.
struct RayEnd {
  double distance_m;
  double factor;
};

/// Rays of one sensor: they leave one point and differ little in direction.
struct Fan {
  Vec3 from;
  Vec2 axis;  ///< unit vector in plan, in their middle
  double half_sin = 0,
         half_cos = 1;   ///< of the angle in plan that no ray leaves the axis by; used unless is_wide
  bool is_wide = false;  ///< rays may go anywhere
  bool is_level = false;
  double range_m = 0;
  std::vector<Vec3> dirs;  ///< unit vectors

  /// Ends of rays that meet nothing.
  void end_freely(RayEnd* ends) const {
    for (std::size_t i = 0; i < dirs.size(); ++i) ends[i] = {range_m, 1};
  }
};

/// cast_ray() for each ray of a fan, whose ends are not beyond its range; `factor` for those that meet the
/// solid. True when one does. Without `has_ends` nothing was met before: `ends` hold something only once this
/// has returned true.
bool cast_fan(const Fan& fan, const Placed& what, double factor, RayEnd* ends, bool has_ends = true);

/// True when no ray from a point can meet the solid within `range_m`, if it leaves within half_sin/half_cos
/// (sine and cosine of the half angle) of the axis. Sure when true; when false, cast.
bool out_of_sight(Vec2 from, Vec2 axis, double half_sin, double half_cos, double range_m, const Placed& what);

/// Distance in the plane from a point to the solid's footprint, m; negative inside. `toward`, if given, gets
/// the unit vector from the solid's nearest point towards the point.
double plan_distance_m(Vec2 point, const Placed& what, Vec2* toward = nullptr);

}  // namespace sim
