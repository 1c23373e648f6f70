// SPDX-License-Identifier: MIT
// Where nodes within nodes end up: a turn with scale, and a shift, as Eigen has them. Metres.
#pragma once
#include <Eigen/Geometry>
#include <cmath>

#include "sim_core/geometry/pose.h"

namespace wbt {

using sim::Vec2;
using Vec3 = Eigen::Vector3d;  ///< of numbers, or Vec3::Zero(): by itself it begins as anything

/// Eigen's, which would begin as anything, too; here as no turn and no shift.
struct Affine : Eigen::Affine3d {
  Affine() : Eigen::Affine3d(Identity()) {}
  template <class Other>
  Affine(const Other& other) : Eigen::Affine3d(other) {}
};

inline sim::Vec3 plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// A turn about an axis of any length (none: no turn), rad.
inline Affine turned(const Vec3& axis, double angle_rad) {
  const double n = axis.norm();
  if (!(n > 1e-12) || !std::isfinite(n) || !std::isfinite(angle_rad)) return {};
  return Eigen::AngleAxisd(angle_rad, axis / n);
}

}  // namespace wbt
