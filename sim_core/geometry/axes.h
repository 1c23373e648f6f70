// SPDX-License-Identifier: MIT
// The axes of older worlds of other simulators: NUE, x to the right, y up, z towards the reader; a robot at
// angle 0 looks along -z. Ours are ENU: x east, y north, z up; heading 0 looks along +x.
#pragma once
#include "sim_core/geometry/pose.h"

namespace sim {

enum class Axes { Enu, Nue };

constexpr Vec3 to_nue(Vec3 p) { return {p.x, p.z, -p.y}; }

/// Angle by which a NUE world turns a robot of that heading about its upward y axis; rad.
constexpr double angle_to_nue(double heading_rad) { return heading_rad - kPi / 2; }

}  // namespace sim
