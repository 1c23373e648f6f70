// SPDX-License-Identifier: MIT
// GJK over support functions of shrunken prisms, cylinders and balls. CCD_INIT leaves the iteration limit at
// ULONG_MAX, so it is always set here.
#include "sim_core/geometry/overlap.h"

#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

constexpr unsigned long kMostIterations = 200;  // GJK on these shapes ends within a few dozen

struct Shape {
  const Placed* placed;
  double shrink_m;
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  // The point of the body, made smaller by the slack, that lies furthest in a direction, as
  // libccd asks for it.
  const Shape& shape = *static_cast<const Shape*>(object);
  const Placed& p = *shape.placed;
  const Solid& s = *p.solid;
  const double dx = ccdVec3X(direction), dy = ccdVec3Y(direction), dz = ccdVec3Z(direction);
  const double z0 = p.z_m + s.z0_m, z1 = p.z_m + s.z1_m;
  if (s.kind == SolidKind::Ball) {
    const double len = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double k = len > 0 ? std::max(0.0, s.radius_m - shape.shrink_m) / len : 0.0;
    ccdVec3Set(out, p.frame.at.x + k * dx, p.frame.at.y + k * dy, z0 + s.radius_m + k * dz);
    return;
  }
  const double half = std::max(0.0, 0.5 * (z1 - z0) - shape.shrink_m);
  const double z = 0.5 * (z0 + z1) + (dz > 0 ? half : -half);
  if (s.kind == SolidKind::Cylinder) {
    const double len = std::sqrt(dx * dx + dy * dy);
    const double k = len > 0 ? std::max(0.0, s.radius_m - shape.shrink_m) / len : 0.0;
    ccdVec3Set(out, p.frame.at.x + k * dx, p.frame.at.y + k * dy, z);
    return;
  }
  // the corner that reaches furthest, drawn in towards the middle of the outline by the slack
  const Vec2 dir = p.frame.turn_back({dx, dy});
  Vec2 best = s.outline.front();
  Vec2 middle;
  for (const Vec2& corner : s.outline) {
    if (dot(corner, dir) > dot(best, dir)) best = corner;
    middle = middle + (1.0 / static_cast<double>(s.outline.size())) * corner;
  }
  const Vec2 in = middle - best;
  const double len = length(in);
  const double k =
      len > 0 ? std::min(1.0, 1.4142 * shape.shrink_m / len) : 0.0;  // sqrt 2: at a square corner
  const Vec2 w = p.frame.to_world(best + k * in);
  ccdVec3Set(out, w.x, w.y, z);
}

}  // namespace

bool overlaps(const Placed& a, const Placed& b, double slack_m) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support;
  ccd.support2 = support;
  ccd.max_iterations = kMostIterations;
  const Shape sa{&a, 0.5 * slack_m};
  const Shape sb{&b, 0.5 * slack_m};
  return ccdGJKIntersect(&sa, &sb, &ccd) != 0;
}

}  // namespace sim
