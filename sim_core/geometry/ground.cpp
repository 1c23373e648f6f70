// SPDX-License-Identifier: MIT
#include "sim_core/geometry/ground.h"

#include <algorithm>
#include <cmath>

namespace sim {

namespace {
constexpr double kEdgeM = 1e-9;  // points on a ramp's very edge are on it
}

Ground::Ground(const std::vector<Ramp>& ramps, double tilt_x_rad, double tilt_y_rad) {
  if (tilt_x_rad != 0 || tilt_y_rad != 0) {
    const double x = sin_cos(tilt_x_rad).s, y = sin_cos(tilt_y_rad).s;
    down_ = {-x, -y, -std::sqrt(1 - x * x - y * y)};
  }
  for (const Ramp& r : ramps) {
    parts_.push_back({Frame2(r.pose), 0.5 * r.length_m, 0.5 * r.width_m,
                      0.5 * length({r.length_m, r.width_m}), 0.5 * (r.low_m + r.high_m),
                      (r.high_m - r.low_m) / r.length_m});
  }
}

double Ground::height_m(Vec2 at) const {
  double height = 0;
  for (const Part& p : parts_) {
    const Vec2 local = p.frame.to_local(at);
    if (std::fabs(local.x) > p.half_length_m + kEdgeM || std::fabs(local.y) > p.half_width_m + kEdgeM)
      continue;
    height = std::max(height, p.middle_m + local.x * p.rise);
  }
  return height;
}

Footing Ground::footing(const Pose2& pose, double half_length_m, double half_width_m) const {
  const Vec2 at{pose.x_m, pose.y_m};
  const double reach = std::max(half_length_m, half_width_m);
  const bool any = std::any_of(parts_.begin(), parts_.end(), [&](const Part& p) {
    const Vec2 gap = p.frame.at - at;
    return dot(gap, gap) <= (p.reach_m + reach) * (p.reach_m + reach);
  });
  if (!any) return {};
  const Frame2 frame(pose);
  const Vec2 along = half_length_m * frame.turn({1, 0}), across = half_width_m * frame.turn({0, 1});
  const double left = height_m(at + across), right = height_m(at - across);
  const Vec2 slope{(height_m(at + along) - height_m(at - along)) / (2 * half_length_m),
                   (left - right) / (2 * half_width_m)};
  return {0.5 * (left + right), frame.turn(slope)};
}

bool Ground::is_smooth(const Pose2& pose, double half_length_m, double half_width_m) const {
  double steepest = 0;
  const double reach = std::max(half_length_m, half_width_m);
  for (const Part& p : parts_) {
    const Vec2 gap = p.frame.at - Vec2{pose.x_m, pose.y_m};
    if (dot(gap, gap) <= (p.reach_m + reach) * (p.reach_m + reach))
      steepest = std::max(steepest, std::fabs(p.rise));
  }
  const Frame2 frame(pose);
  const Vec2 along = half_length_m * frame.turn({1, 0}), across = half_width_m * frame.turn({0, 1});
  const double middle = height_m(frame.at);
  const auto meets = [&](Vec2 way) {
    return std::fabs(height_m(frame.at + way) - middle) <= steepest * length(way) + kEdgeM;
  };
  return meets(along) && meets(-1 * along) && meets(across) && meets(-1 * across);
}

int Ground::cast(const Ray& ray, double& distance_m, Vec3* normal) const {
  int hit = -1;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& p = parts_[i];
    const Vec2 from = p.frame.to_local({ray.from.x, ray.from.y});
    const Vec2 dir = p.frame.turn_back({ray.dir.x, ray.dir.y});
    // height above the ramp's plane along the ray: over - t * sinking
    const double over = ray.from.z - (p.middle_m + from.x * p.rise);
    const double sinking = dir.x * p.rise - ray.dir.z;
    if (over < 0 || sinking <= 1e-12) continue;
    const double t = over / sinking;
    if (t >= distance_m || std::fabs(from.x + t * dir.x) > p.half_length_m ||
        std::fabs(from.y + t * dir.y) > p.half_width_m) {
      continue;
    }
    distance_m = t;
    hit = static_cast<int>(i);
    if (!normal) continue;
    const Vec2 up = (-p.rise) * p.frame.turn({1, 0});
    const double size = std::sqrt(1 + p.rise * p.rise);
    *normal = {up.x / size, up.y / size, 1 / size};
  }
  return hit;
}

BodyAxes axes_on(Vec2 slope, double heading_rad) {
  const SinCos h = sin_cos(heading_rad);
  BodyAxes axes;
  if (slope.x == 0 && slope.y == 0) {
    axes.forward = {h.c, h.s, 0};
    axes.left = {-h.s, h.c, 0};
    return axes;
  }
  const double rise = slope.x * h.c + slope.y * h.s;
  const double along = 1 / std::sqrt(1 + rise * rise);
  axes.forward = {along * h.c, along * h.s, along * rise};
  const double up = 1 / std::sqrt(1 + dot(slope, slope));
  axes.up = {-up * slope.x, -up * slope.y, up};
  axes.left = cross(axes.up, axes.forward);
  return axes;
}

SlopeEffect slope_effect(Vec2 slope, double heading_rad, const Vec3& down) {
  SlopeEffect e;
  const double gradient2 = dot(slope, slope);
  e.steep = 1 / std::sqrt(1 + gradient2);
  const Vec3 up{-e.steep * slope.x, -e.steep * slope.y, e.steep};
  e.press = -dot(down, up);
  e.pull = {down.x + e.press * up.x, down.y + e.press * up.y};
  if (gradient2 == 0) return e;
  e.uphill = (1 / std::sqrt(gradient2)) * slope;
  const SinCos h = sin_cos(heading_rad);
  const double rise = slope.x * h.c + slope.y * h.s;
  e.way = 1 / std::sqrt(1 + rise * rise);
  const double facing = h.c * e.uphill.x + h.s * e.uphill.y;
  e.turn = (facing * facing + e.steep * e.steep * (1 - facing * facing)) / e.steep;
  return e;
}

Vec2 behind_bend(Vec2 plan, Vec2 before, Vec2 after) {
  const Vec2 push = 0.5 * (before + after);
  const double climbed = dot(before, plan), climbs = dot(after, plan), along = dot(after, push);
  // |plan - k push|^2 + (after . (plan - k push))^2 = |plan|^2 + climbed^2, solved for the smaller k
  const double square = dot(push, push) + along * along, half = dot(plan, push) + climbs * along,
               rest = climbs * climbs - climbed * climbed;
  if (square == 0 || rest == 0) return plan;
  const double inside = half * half - square * rest;
  const double k = inside <= 0 ? half / square : rest / (half + std::copysign(std::sqrt(inside), half));
  return plan - k * push;
}

double surface_length(const SlopeEffect& slope, Vec2 plan) {
  const double up = dot(plan, slope.uphill);
  return std::sqrt(dot(plan, plan) + up * up * (1 / (slope.steep * slope.steep) - 1));
}

}  // namespace sim
