// SPDX-License-Identifier: MIT
// Rays are clipped against half planes (prism), a circle (cylinder) or a sphere (ball), then against the
// height range. Most solids are boxes and most rays level: these have a shorter way.
#include "sim_core/geometry/solid.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"

namespace sim {
namespace {

constexpr double kParallel = 1e-12;       // below this a direction counts as parallel to a plane
constexpr double kOnSideM = 1e-12;        // a point that near to a side lies on it
constexpr double kSmallestAreaM2 = 1e-6;  // one square millimetre

double signed_area_m2(const std::vector<Vec2>& corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    twice += cross(corners[i], corners[(i + 1) % corners.size()]);
  return 0.5 * twice;
}

/// Narrows [near, far] to where the ray is between the heights; false when nothing is left.
bool clip_heights(double z, double dz, double z0, double z1, double& near, double& far,
                  bool& entered_by_cap) {
  if (std::fabs(dz) < kParallel) return z >= z0 && z <= z1;
  double first = (z0 - z) / dz;
  double last = (z1 - z) / dz;
  if (first > last) std::swap(first, last);
  if (first > near) {
    near = first;
    entered_by_cap = true;
  }
  far = std::min(far, last);
  return near <= far;
}

/// How far a point lies outside of a box's nearer side along each axis, m; negative: between the two sides.
Vec2 outside_of_box(Vec2 p, Vec2 half) { return {std::fabs(p.x) - half.x, std::fabs(p.y) - half.y}; }

/// A side that the fan's point is outside of must come near fast enough along the best ray. Of the axis:
/// the parts towards the side and along it.
inline bool is_too_far(double outside, double facing, double along, double half_sin, double half_cos,
                       double range_m) {
  if (outside <= 0) return false;
  if (outside > range_m) return true;
  const double best = facing >= half_cos ? 1 : facing * half_cos + std::fabs(along) * half_sin;
  return outside > range_m * best + 1e-12;
}

/// A box as a point sees it: mirrored so that the point lies beside or behind its upper and right sides.
class SeenBox {
 public:
  SeenBox(Vec2 point, const Placed& what)
      : half_(what.solid->half_m), c_(what.frame.c), s_(what.frame.s), from_(what.frame.to_local(point)) {
    mirror_ = {std::copysign(1.0, from_.x), std::copysign(1.0, from_.y)};
    from_ = {std::fabs(from_.x), std::fabs(from_.y)};
    outside_ = {from_.x - half_.x, from_.y - half_.y};
  }

  /// A level ray enters through the last of the sides that it has to cross.
  bool let_in(double x, double y, double& distance_m) const {
    const Vec2 speed = approach(x, y);
    double near = 0;
    if (outside_.x > 0) {
      if (speed.x < kParallel) return false;
      near = outside_.x / speed.x;
    }
    if (outside_.y > 0) {
      if (speed.y < kParallel) return false;
      near = std::max(near, outside_.y / speed.y);
    }
    if (near >= distance_m) return false;
    if (near > 0 && (std::fabs(from_.x - near * speed.x) - half_.x > kOnSideM ||
                     std::fabs(from_.y - near * speed.y) - half_.y > kOnSideM))
      return false;
    distance_m = near;
    return true;
  }
  bool is_out_of_sight(Vec2 axis, double half_sin, double half_cos, double range_m) const {
    const Vec2 facing = approach(axis.x, axis.y);
    return is_too_far(outside_.x, facing.x, facing.y, half_sin, half_cos, range_m) ||
           is_too_far(outside_.y, facing.y, facing.x, half_sin, half_cos, range_m);
  }

 private:
  /// How fast a direction comes nearer to the two sides.
  Vec2 approach(double x, double y) const {
    return {-mirror_.x * (c_ * x + s_ * y), -mirror_.y * (c_ * y - s_ * x)};
  }

  Vec2 half_;
  double c_, s_;
  Vec2 from_, mirror_, outside_;
};

/// A level ray and a circle around the origin, which lies outside of it if `c`, the square of its distance
/// less that of the radius, is positive.
bool enter_circle(Vec2 from, double c, Vec2 dir, double& distance_m) {
  double near = 0;
  if (c > 0) {
    const double a = dot(dir, dir), b = dot(from, dir);
    if (b >= 0) return false;
    const double disc = b * b - a * c;
    if (disc < 0) return false;
    near = std::max(0.0, (-b - std::sqrt(disc)) / a);
  }
  if (near >= distance_m) return false;
  distance_m = near;
  return true;
}

bool is_at_height(double z_m, const Placed& what) {
  const double z = z_m - what.z_m;
  return z >= what.solid->z0_m && z <= what.solid->z1_m;
}

/// The last of a cast at an upright solid, which the ray is above or beside from `near` to `far`: its two
/// caps. `by_side`: it came in through a side there, whose normal is `side_normal(where)`; else it begins
/// inside.
template <typename Normal>
bool end_between_heights(const Ray& ray, const Placed& what, double near, double far, double& distance_m,
                         Vec3* normal, bool by_side, Normal side_normal) {
  bool by_cap = false;
  const double z0 = what.z_m + what.solid->z0_m;
  const double z1 = what.z_m + what.solid->z1_m;
  if (!clip_heights(ray.from.z, ray.dir.z, z0, z1, near, far, by_cap) || near >= distance_m) return false;
  distance_m = near;
  if (!normal) return true;
  if (by_cap)
    *normal = {0, 0, ray.dir.z < 0 ? 1.0 : -1.0};
  else
    *normal = by_side ? side_normal(near) : Vec3{-ray.dir.x, -ray.dir.y, -ray.dir.z};
  return true;
}

bool cast_prism(const Ray& ray, const Placed& what, double& distance_m, Vec3* normal) {
  // In the solid's own frame.
  const Frame2& f = what.frame;
  const Vec2 from = f.to_local({ray.from.x, ray.from.y});
  const Vec2 dir = f.turn_back({ray.dir.x, ray.dir.y});
  // The ray is inside between the last side that it enters and the first that it leaves.
  double near = 0;
  double far = distance_m;
  const HalfPlane* entered = nullptr;
  for (const HalfPlane& side : what.solid->sides) {
    const double along = dot(side.normal, dir);
    const double outside = dot(side.normal, from) - side.offset_m;
    if (std::fabs(along) < kParallel) {
      if (outside > 0) return false;
      continue;
    }
    const double t = -outside / along;
    if (along < 0) {
      if (t > near) {
        near = t;
        entered = &side;
      }
    } else {
      far = std::min(far, t);
    }
    if (near > far) return false;
  }
  return end_between_heights(ray, what, near, far, distance_m, normal, entered != nullptr, [&](double) {
    const Vec2 n = f.turn(entered->normal);
    return Vec3{n.x, n.y, 0};
  });
}

bool cast_cylinder(const Ray& ray, const Placed& what, double& distance_m, Vec3* normal) {
  // Where the ray in plan meets the circle: a t^2 + 2 b t + c = 0.
  const Vec2 rel{ray.from.x - what.frame.at.x, ray.from.y - what.frame.at.y};
  const Vec2 dir{ray.dir.x, ray.dir.y};
  const double r = what.solid->radius_m;
  const double a = dot(dir, dir);
  const double b = dot(rel, dir);
  const double c = dot(rel, rel) - r * r;
  double near = 0;
  double far = distance_m;
  bool by_side = false;
  if (a < kParallel) {
    if (c > 0) return false;
  } else {
    if (c > 0 && b >= 0) return false;
    const double disc = b * b - a * c;
    if (disc < 0) return false;
    const double root = std::sqrt(disc);
    const double first = (-b - root) / a;
    if (first > near) {
      near = first;
      by_side = true;
    }
    far = std::min(far, (-b + root) / a);
    if (near > far) return false;
  }
  return end_between_heights(ray, what, near, far, distance_m, normal, by_side, [&](double at_m) {
    return Vec3{(rel.x + at_m * dir.x) / r, (rel.y + at_m * dir.y) / r, 0};
  });
}

bool cast_ball(const Ray& ray, const Placed& what, double& distance_m, Vec3* normal) {
  const double r = what.solid->radius_m;
  const Vec3 rel{ray.from.x - what.frame.at.x, ray.from.y - what.frame.at.y,
                 ray.from.z - (what.z_m + what.solid->z0_m + r)};
  const double b = rel.x * ray.dir.x + rel.y * ray.dir.y + rel.z * ray.dir.z;
  const double c = rel.x * rel.x + rel.y * rel.y + rel.z * rel.z - r * r;
  if (c > 0 && b >= 0) return false;
  const double disc = b * b - c;
  if (disc < 0) return false;
  const double near = std::max(0.0, -b - std::sqrt(disc));
  if (near >= distance_m) return false;
  distance_m = near;
  if (normal) {
    *normal = {(rel.x + near * ray.dir.x) / r, (rel.y + near * ray.dir.y) / r,
               (rel.z + near * ray.dir.z) / r};
  }
  return true;
}

}  // namespace

std::vector<Vec2> counter_clockwise(std::vector<Vec2> corners) {
  if (signed_area_m2(corners) < 0) std::reverse(corners.begin(), corners.end());
  return corners;
}

bool is_convex(const std::vector<Vec2>& corners) {
  const std::size_t n = corners.size();
  if (n < 3) return false;
  const std::vector<Vec2> ring = counter_clockwise(corners);
  if (signed_area_m2(ring) < kSmallestAreaM2) return false;
  double turned = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = ring[(i + 1) % n] - ring[i];
    const Vec2 b = ring[(i + 2) % n] - ring[(i + 1) % n];
    if (length(a) < 1e-6 || cross(a, b) <= 1e-9 * length(a) * length(b)) return false;
    turned += std::atan2(cross(a, b), dot(a, b));
  }
  return turned < 2 * kPi + 1e-6;  // a pentagram turns left everywhere, but twice round
}

Solid Solid::prism(std::vector<Vec2> corners, double z0_m, double z1_m) {
  CHECK(corners.size() >= 3, "a prism has at least three corners");
  Solid s;
  s.kind = SolidKind::Prism;
  s.outline = std::move(corners);
  s.z0_m = z0_m;
  s.z1_m = z1_m;
  for (std::size_t i = 0; i < s.outline.size(); ++i) {
    const Vec2 a = s.outline[i];
    const Vec2 edge = s.outline[(i + 1) % s.outline.size()] - a;
    const double len = length(edge);
    const Vec2 normal{edge.y / len, -edge.x / len};
    s.sides.push_back({normal, dot(normal, a)});
    s.bound_m = std::max(s.bound_m, length(a));
  }
  return s;
}

Solid Solid::box(double size_x_m, double size_y_m, double z0_m, double z1_m) {
  const double x = 0.5 * size_x_m;
  const double y = 0.5 * size_y_m;
  Solid s = prism({{x, y}, {-x, y}, {-x, -y}, {x, -y}}, z0_m, z1_m);
  s.half_m = {x, y};
  return s;
}

Solid Solid::cylinder(double radius_m, double z0_m, double z1_m) {
  Solid s;
  s.kind = SolidKind::Cylinder;
  s.radius_m = radius_m;
  s.z0_m = z0_m;
  s.z1_m = z1_m;
  s.bound_m = radius_m;
  return s;
}

Solid Solid::ball(double radius_m) {
  Solid s = cylinder(radius_m, 0, 2 * radius_m);
  s.kind = SolidKind::Ball;
  return s;
}

double Solid::gyration_m2() const {
  if (kind == SolidKind::Cylinder) return 0.5 * radius_m * radius_m;
  if (kind == SolidKind::Ball) return 0.4 * radius_m * radius_m;
  double area = 0;
  double moment = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i];
    const Vec2 b = outline[(i + 1) % outline.size()];
    const double c = cross(a, b);
    area += 0.5 * c;
    moment += c * (dot(a, a) + dot(a, b) + dot(b, b)) / 12.0;
  }
  return moment / area;
}

bool cast_ray(const Ray& ray, const Placed& what, double& distance_m, Vec3* normal) {
  switch (what.solid->kind) {
    case SolidKind::Prism:
      if (what.solid->is_box() && !normal && std::fabs(ray.dir.z) < kParallel) {
        return is_at_height(ray.from.z, what) &&
               SeenBox({ray.from.x, ray.from.y}, what).let_in(ray.dir.x, ray.dir.y, distance_m);
      }
      return cast_prism(ray, what, distance_m, normal);
    case SolidKind::Cylinder:
      return cast_cylinder(ray, what, distance_m, normal);
    case SolidKind::Ball:
      return cast_ball(ray, what, distance_m, normal);
  }
  return false;
}

namespace {

template <typename Meets>
bool cast_each(const Fan& fan, double factor, RayEnd* ends, bool has_ends, Meets meets) {
  if (!has_ends) fan.end_freely(ends);
  bool any = false;
  for (const Vec3& dir : fan.dirs) {
    if (meets(dir, ends->distance_m)) {
      ends->factor = factor;
      any = true;
    }
    ++ends;
  }
  return any;
}

__attribute__((noinline)) bool cast_at_any(const Fan& fan, const Placed& what, double factor, RayEnd* ends,
                                           bool has_ends) {
  return cast_each(fan, factor, ends, has_ends, [&](const Vec3& dir, double& distance_m) {
    return cast_ray({fan.from, dir}, what, distance_m);
  });
}

__attribute__((noinline)) bool cast_at_box(const Fan& fan, const Placed& what, double factor, RayEnd* ends,
                                           bool has_ends) {
  const SeenBox box({fan.from.x, fan.from.y}, what);
  if (!fan.is_wide && box.is_out_of_sight(fan.axis, fan.half_sin, fan.half_cos, fan.range_m)) return false;
  return cast_each(fan, factor, ends, has_ends,
                   [&](const Vec3& dir, double& distance_m) { return box.let_in(dir.x, dir.y, distance_m); });
}

/// No ray within a plan angle of the axis can touch the circle around the solid.
inline bool misses_bound(Vec2 gap, Vec2 axis, double half_sin, double range_m, double bound_m) {
  return dot(gap, gap) > (range_m + bound_m) * (range_m + bound_m) || dot(gap, axis) < -bound_m ||
         std::fabs(cross(axis, gap)) > bound_m + range_m * half_sin;
}

}  // namespace

bool cast_at_other(const Fan& fan, const Placed& what, double factor, RayEnd* ends, bool has_ends) {
  const Solid& solid = *what.solid;
  const Vec2 point{fan.from.x, fan.from.y};
  if (solid.kind == SolidKind::Cylinder && fan.is_level) {
    const Vec2 gap = what.frame.at - point;
    if (!fan.is_wide && misses_bound(gap, fan.axis, fan.half_sin, fan.range_m, solid.bound_m)) return false;
    const Vec2 from = point - what.frame.at;
    const double c = dot(from, from) - solid.radius_m * solid.radius_m;
    return cast_each(fan, factor, ends, has_ends, [&](const Vec3& dir, double& distance_m) {
      return enter_circle(from, c, {dir.x, dir.y}, distance_m);
    });
  }
  if (!fan.is_wide && out_of_sight(point, fan.axis, fan.half_sin, fan.half_cos, fan.range_m, what))
    return false;
  return cast_at_any(fan, what, factor, ends, has_ends);
}

bool cast_fan(const Fan& fan, const Placed& what, double factor, RayEnd* ends, bool has_ends) {
  if (fan.is_level && !is_at_height(fan.from.z, what)) return false;
  return fan.is_level && what.solid->is_box() ? cast_at_box(fan, what, factor, ends, has_ends)
                                              : cast_at_other(fan, what, factor, ends, has_ends);
}

bool out_of_sight(Vec2 from, Vec2 axis, double half_sin, double half_cos, double range_m,
                  const Placed& what) {
  if (misses_bound(what.frame.at - from, axis, half_sin, range_m, what.solid->bound_m)) return true;
  if (what.solid->kind != SolidKind::Prism) return false;
  if (what.solid->is_box()) return SeenBox(from, what).is_out_of_sight(axis, half_sin, half_cos, range_m);
  const Vec2 point = what.frame.to_local(from);
  const Vec2 dir = what.frame.turn_back(axis);
  for (const HalfPlane& side : what.solid->sides)
    if (is_too_far(dot(side.normal, point) - side.offset_m, -dot(side.normal, dir), cross(side.normal, dir),
                   half_sin, half_cos, range_m))
      return true;
  return false;
}

Placed placed_at(const Solid& solid, const Pose2& pose, double z_m) {
  Placed out{&solid, Frame2(), z_m};
  if (solid.kind == SolidKind::Prism)
    out.frame = Frame2(pose);
  else
    out.frame.at = {pose.x_m, pose.y_m};
  return out;
}

double plan_distance_m(Vec2 point, const Placed& what, Vec2* toward) {
  const Solid& s = *what.solid;
  if (s.kind != SolidKind::Prism) {  // looks the same whichever way it has turned
    const Vec2 gap = point - what.frame.at;
    const double d = length(gap);
    if (toward) *toward = d > 0 ? Vec2{gap.x / d, gap.y / d} : Vec2{1, 0};
    return d - s.radius_m;
  }
  const Vec2 p = what.frame.to_local(point);
  // inside: the least deep side; outside: the nearest edge
  if (s.is_box()) {
    const Vec2 outside = outside_of_box(p, s.half_m), side{p.x > 0 ? 1.0 : -1.0, p.y > 0 ? 1.0 : -1.0};
    const Vec2 away{std::max(outside.x, 0.0), std::max(outside.y, 0.0)};
    const bool is_x = outside.x > outside.y;
    // beside a side: no root
    if (away.x == 0 || away.y == 0) {
      if (toward) *toward = what.frame.turn(is_x ? Vec2{side.x, 0} : Vec2{0, side.y});
      return is_x ? outside.x : outside.y;
    }
    const double d = length(away);
    if (toward) *toward = what.frame.turn({side.x * away.x / d, side.y * away.y / d});
    return d;
  }
  // Any prism: the side that the point is furthest outside of.
  double deepest = -1e300;
  Vec2 normal;
  for (const HalfPlane& side : s.sides) {
    const double d = dot(side.normal, p) - side.offset_m;
    if (d > deepest) {
      deepest = d;
      normal = side.normal;
    }
  }
  if (deepest <= 0) {
    if (toward) *toward = what.frame.turn(normal);
    return deepest;
  }
  double best = 1e300;
  Vec2 away;
  for (std::size_t i = 0; i < s.outline.size(); ++i) {
    const Vec2 a = s.outline[i];
    const Vec2 edge = s.outline[(i + 1) % s.outline.size()] - a;
    const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
    const Vec2 gap = p - (a + t * edge);
    const double d2 = dot(gap, gap);
    if (d2 < best) {
      best = d2;
      away = gap;
    }
  }
  const double d = std::sqrt(best);
  if (toward) *toward = d > 0 ? what.frame.turn({away.x / d, away.y / d}) : what.frame.turn(normal);
  return d;
}

}  // namespace sim
