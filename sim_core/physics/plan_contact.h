// SPDX-License-Identifier: MIT
// How deep two upright solids are inside each other, seen from above.
#pragma once
#include "sim_core/geometry/solid.h"

namespace sim {

struct PlanContact {
  double depth_m = 0;  ///< overlap; negative: a lower bound of the gap
  Vec2 normal;         ///< unit vector from the second solid towards the first
  Vec2 point;          ///< where they touch, world frame, m
};

/// Any two solids; heights do not count. Two prisms: by the side along which the overlap is least.
PlanContact plan_contact(const Placed& a, const Placed& b);

}  // namespace sim
