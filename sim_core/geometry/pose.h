// SPDX-License-Identifier: MIT
// Planar vectors and poses. Metres and radians; x forward or east, y left or north, headings
// counter-clockwise.
#pragma once
#include <cmath>

#include "sim_core/base/portable_math.h"

namespace sim {

inline constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

/// A point or a direction in the plane, m.
struct Vec2 {
  double x = 0;
  double y = 0;
};

constexpr bool operator==(Vec2 a, Vec2 b) { return a.x == b.x && a.y == b.y; }
constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(double k, Vec2 a) { return {k * a.x, k * a.y}; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return std::sqrt(dot(a, a)); }

/// A point or a direction in space, m.
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// Where a body stands on the plane.
struct Pose2 {
  double x_m = 0;
  double y_m = 0;
  double heading_rad = 0;  ///< counter-clockwise from +x; not wrapped, so a full turn is visible
};

/// The same pose with the heading as a rotation, ready to turn vectors.
struct Frame2 {
  Vec2 at;
  double c = 1;  ///< cosine of the heading
  double s = 0;  ///< sine of the heading

  Frame2() = default;
  explicit Frame2(const Pose2& p) : at{p.x_m, p.y_m} {
    const SinCos turn = sin_cos(p.heading_rad);
    c = turn.c;
    s = turn.s;
  }

  Vec2 turn(Vec2 v) const { return {c * v.x - s * v.y, s * v.x + c * v.y}; }
  Vec2 turn_back(Vec2 v) const { return {c * v.x + s * v.y, c * v.y - s * v.x}; }
  Vec2 to_world(Vec2 local) const { return at + turn(local); }
  Vec2 to_local(Vec2 world) const { return turn_back(world - at); }
  /// Another frame as seen from this one.
  Frame2 to_local(const Frame2& other) const {
    Frame2 seen;
    seen.at = to_local(other.at);
    seen.c = c * other.c + s * other.s;
    seen.s = c * other.s - s * other.c;
    return seen;
  }
};

/// Pose after travelling `forward_m` along an arc that turns by `turn_rad`: half the turn, the
/// way, half the turn.
inline Pose2 advance(const Pose2& p, double forward_m, double turn_rad) {
  const SinCos middle = sin_cos(p.heading_rad + 0.5 * turn_rad);
  return {p.x_m + forward_m * middle.c, p.y_m + forward_m * middle.s, p.heading_rad + turn_rad};
}

}  // namespace sim
