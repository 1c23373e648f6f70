// SPDX-License-Identifier: MIT
// The engine without forces: a robot follows its wheels exactly (half the turn, the way, half the turn) and
// stops short of whatever it would enter; it can still turn on the spot and drive away. Loose objects fall
// and bounce straight up and down (heights.cpp), onto robots too; they do not move in the plane, and drop
// when the robot under them drives away.
#include <algorithm>
#include <cmath>

#include "sim_core/physics/motion.h"
#include "sim_core/physics/physics_params.h"

namespace sim {
namespace {

class KinematicMotion final : public Motion {
 public:
  explicit KinematicMotion(MotionDesc desc) : Motion(std::move(desc), true, false, true) {}

 protected:
  void step_plane(const Neighbours& neighbours) override {
    for (int r : near_) {
      BodyState& b = bodies_[static_cast<std::size_t>(r)];
      const Pose2 from = b.pose;
      drive_freely(r, wanted(r));
      b.pose = stop_short(r, from, b.pose, neighbours);
      b.velocity_m_s = {(b.pose.x_m - from.x_m) / tick_s_, (b.pose.y_m - from.y_m) / tick_s_};
    }
  }

 private:
  /// The furthest pose on the way that enters nothing more than `from` does.
  Pose2 stop_short(int r, const Pose2& from, const Pose2& to, const Neighbours& neighbours) {
    const BodyState& b = bodies_[static_cast<std::size_t>(r)];
    const Solid& me = *desc_.solids[static_cast<std::size_t>(r)];
    const Vec2 start{from.x_m, from.y_m};
    const Vec2 way{to.x_m - from.x_m, to.y_m - from.y_m};
    double allowed = 1;
    bool wall = false, anything = false;
    for (const Candidate* c = neighbours.begin(r); c != neighbours.end(r); ++c) {
      const Placed other = c->moving ? placed(c->index) : (*desc_.fixed)[static_cast<std::size_t>(c->index)];
      if (!heights_meet(b.z_m + me.z0_m, b.z_m + me.z1_m, other.z_m + other.solid->z0_m,
                        other.z_m + other.solid->z1_m)) {
        continue;
      }
      const double gap = plan_distance_m(start, other) - me.bound_m;
      const double least = std::min(gap, 0.5 * kTouchM);
      // does it enter the other, that far on its way?
      const auto enters = [&](double part) {
        return plan_distance_m(start + part * way, other) - me.bound_m < least;
      };
      if (gap < kTouchM) {
        anything = true;
        wall = wall || !c->moving;
      }
      if (!enters(allowed)) continue;
      // The furthest place that does not, by halving.
      double free = 0, blocked = allowed;
      for (int round = 0; round < 30; ++round) {
        const double middle = 0.5 * (free + blocked);
        (enters(middle) ? blocked : free) = middle;
      }
      allowed = free;
      anything = true;
      wall = wall || !c->moving;
    }
    if (anything) note_touch(r, wall);
    return {from.x_m + allowed * way.x, from.y_m + allowed * way.y, to.heading_rad};
  }
};

}  // namespace

std::unique_ptr<Motion> make_kinematic_motion(MotionDesc desc) {
  return std::make_unique<KinematicMotion>(std::move(desc));
}

}  // namespace sim
