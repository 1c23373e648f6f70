// SPDX-License-Identifier: MIT
#include "sim_core/physics/plan_contact.h"

#include <algorithm>

namespace sim {
namespace {

constexpr double kSameDepthM = 1e-4;  // corners within this of the deepest share the contact

/// Of a prism's sides the one that the other prism is least deep behind.
struct Face {
  double depth_m = 1e300;
  Vec2 normal;  // world frame, out of the prism that has the face
  Vec2 point;
};

Face least_deep(const Placed& of, const Placed& other) {
  Face best;
  for (const HalfPlane& side : of.solid->sides) {
    const Vec2 normal = of.frame.turn(side.normal);
    double deepest = -1e300, inside = -1e300;
    Vec2 sum;
    int count = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (const Vec2& corner : other.solid->outline) {
        const Vec2 p = other.frame.to_world(corner);
        inside = side.offset_m - dot(normal, p - of.frame.at);
        if (pass == 0) {
          deepest = std::max(deepest, inside);
        } else if (inside > deepest - kSameDepthM) {
          sum = sum + p;
          ++count;
        }
      }
      if (pass == 0 && deepest >= best.depth_m) break;
      if (pass == 1) best = {deepest, normal, (1.0 / count) * sum};
    }
  }
  return best;
}

}  // namespace

PlanContact plan_contact(const Placed& a, const Placed& b) {
  PlanContact c;
  const bool round_a = a.solid->kind != SolidKind::Prism, round_b = b.solid->kind != SolidKind::Prism;
  if (round_a) {
    c.depth_m = a.solid->radius_m - plan_distance_m(a.frame.at, b, &c.normal);
    c.point = a.frame.at - a.solid->radius_m * c.normal;
    return c;
  }
  if (round_b) {
    c = plan_contact(b, a);
    c.normal = -1.0 * c.normal;
    return c;
  }
  const Face of_a = least_deep(a, b), of_b = least_deep(b, a);
  if (of_b.depth_m <= of_a.depth_m) return {of_b.depth_m, of_b.normal, of_b.point};
  return {of_a.depth_m, -1.0 * of_a.normal, of_a.point};
}

}  // namespace sim
