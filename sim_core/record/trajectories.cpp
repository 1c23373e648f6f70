// SPDX-License-Identifier: MIT
#include "sim_core/record/trajectories.h"

#include "sim_core/world/scene.h"

namespace sim {
namespace {

constexpr double kPointM = 0.001;
constexpr std::size_t kMostPoints = 400'000;  // of a way, some 400 m
constexpr std::size_t kMostInTrail = 20'000;  // of a trail: 20 m or more

}  // namespace

void Trajectories::sample(const Scene& scene) {
  for (std::size_t r = 0; r < ways_.size(); ++r) {
    Way& way = ways_[r];
    const Pose2& p = scene.state(static_cast<int>(r)).pose;
    const Vec2 at{p.x_m, p.y_m};
    if (last_[r].known && length(at - last_[r].at_m) > kJumpM) lift_pen(static_cast<int>(r));
    last_[r] = {at, true};
    const bool lifted = !way.breaks.empty() && way.breaks.back() == way.points_m.size();
    if (!way.points_m.empty() && !lifted && length(at - way.points_m.back()) < kPointM) continue;
    if (way.points_m.size() < kMostPoints) way.points_m.push_back(at);
  }
}

void Trajectories::lift_pen(int robot) {
  Way& way = ways_[static_cast<std::size_t>(robot)];
  if (way.breaks.empty() || way.breaks.back() != way.points_m.size())
    way.breaks.push_back(way.points_m.size());
}

void Trails::sample(const Scene& scene) {
  if (span_ <= 0) return;
  for (std::size_t r = 0; r < trails_.size(); ++r) {
    std::deque<Point>& trail = trails_[r];
    const Pose2& p = scene.state(static_cast<int>(r)).pose;
    const Vec2 at{p.x_m, p.y_m};
    // the point before the span stays, so that a line reaches to its edge
    while (trail.size() > 1 && trail[1].when < scene.now() - span_) trail.pop_front();
    if (trail.size() >= kMostInTrail) trail.pop_front();
    const double moved = trail.empty() ? 0 : length(at - trail.back().at_m);
    const bool lifted = trail.empty() || moved > kJumpM || lifted_[r];
    if (lifted || moved >= kPointM) trail.push_back({at, scene.now(), lifted});
    lifted_[r] = false;
  }
}

}  // namespace sim
