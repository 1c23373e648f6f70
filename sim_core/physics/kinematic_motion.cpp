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
  explicit KinematicMotion(MotionDesc desc) : Motion(std::move(desc), true, false) {}

 protected:
  void step_plane(const RimTravel* travel, const Neighbours& neighbours) override {
    double most = 0;
    for (int r = 0; r < robots(); ++r) {
      most = std::max(most, std::fabs(0.5 * (travel[r].left_m + travel[r].right_m)));
    }
    for (int r = 0; r < robots(); ++r) {
      const RobotBody& body = desc_.robots[static_cast<std::size_t>(r)];
      BodyState& b = bodies_[static_cast<std::size_t>(r)];
      double way = 0.5 * (travel[r].left_m + travel[r].right_m);
      double turn = (travel[r].right_m - travel[r].left_m) / body.axle_m;
      if (is_sloping()) {
        way *= slope_of(r).way;
        turn *= slope_of(r).turn;
      }
      const Pose2 from = b.pose;
      Pose2 to = way == 0 && turn == 0 ? from : advance(from, way, turn);
      if (neighbours.clearance_m(r) - 2 * most < kSolverMarginM) {
        to = stop_short(r, from, to, neighbours);
      } else {
        note_touch(r, false, false);
      }
      b.velocity_m_s = {(to.x_m - from.x_m) / desc_.tick_s, (to.y_m - from.y_m) / desc_.tick_s};
      b.spin_rad_s = turn / desc_.tick_s;
      b.pose = to;
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
      const auto enters = [&](double part) {
        return plan_distance_m(start + part * way, other) - me.bound_m < least;
      };
      if (gap < kTouchM) {
        anything = true;
        wall = wall || !c->moving;
      }
      if (!enters(allowed)) continue;
      double free = 0, blocked = allowed;
      for (int round = 0; round < 30; ++round) {
        const double middle = 0.5 * (free + blocked);
        (enters(middle) ? blocked : free) = middle;
      }
      allowed = free;
      anything = true;
      wall = wall || !c->moving;
    }
    note_touch(r, wall, anything);
    return {from.x_m + allowed * way.x, from.y_m + allowed * way.y, to.heading_rad};
  }
};

}  // namespace

std::unique_ptr<Motion> make_kinematic_motion(MotionDesc desc) {
  return std::make_unique<KinematicMotion>(std::move(desc));
}

}  // namespace sim
