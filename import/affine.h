// SPDX-License-Identifier: MIT
// Where nodes within nodes end up: a turn with scale, and a shift. Metres.
#pragma once
#include <array>
#include <cmath>

#include "sim_core/geometry/pose.h"

namespace wbt {

using sim::Vec2;
using sim::Vec3;

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(wbt::dot(a, a)); }
inline bool is_finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

struct Affine {
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  ///< images of x, y and z
  Vec3 at;

  Vec3 turn(Vec3 v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
  Vec3 place(Vec3 p) const { return turn(p) + at; }
  /// What `inner` means inside this.
  Affine then(const Affine& inner) const {
    return {{turn(inner.axes[0]), turn(inner.axes[1]), turn(inner.axes[2])}, place(inner.at)};
  }
};

/// A turn about an axis of any length (none: no turn), rad.
inline Affine turned(Vec3 axis, double angle_rad) {
  Affine out;
  const double n = length(axis);
  if (!(n > 1e-12) || !std::isfinite(n) || !std::isfinite(angle_rad)) return out;
  const Vec3 u = (1 / n) * axis;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  for (Vec3& e : out.axes) e = c * e + s * wbt::cross(u, e) + (1 - c) * wbt::dot(u, e) * u;
  return out;
}

}  // namespace wbt
