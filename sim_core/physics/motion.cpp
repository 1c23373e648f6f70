// SPDX-License-Identifier: MIT
// What both engines share: wheels to wanted speeds, free motion, heights (falling and resting, by libccd),
// touches.
#include "sim_core/physics/motion.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"
#include "sim_core/geometry/overlap.h"
#include "sim_core/physics/physics_params.h"

namespace sim {
namespace {
constexpr int kOnFloor = -1, kInAir = -2, kOnFixed = -3;
}

Motion::Motion(MotionDesc desc) : desc_(std::move(desc)), bodies_(desc_.start) {
  CHECK(bodies_.size() == desc_.solids.size() && bodies_.size() == desc_.robots.size() + desc_.loose.size(),
        "one start, one solid and one description per moving body");
  CHECK(desc_.surfaces.size() == desc_.fixed->size(), "one surface per fixed solid");
  ticks_per_s_ = 1 / desc_.tick_s;
  for (const RobotBody& r : desc_.robots) {
    const auto limits = [&](double grip_n) {
      return Limits{grip_n * desc_.tick_s / r.mass_kg,
                    grip_n * 0.5 * r.axle_m * desc_.tick_s / r.inertia_kg_m2};
    };
    drives_.push_back({ticks_per_s_ / r.axle_m, limits(r.traction_n), limits(r.hold_n)});
  }
  touches_.resize(desc_.robots.size());
  touch_times_.resize(desc_.robots.size());
  support_.assign(bodies_.size(), kOnFloor);
  sloping_ = desc_.ground && !desc_.ground->is_plain();
  slopes_.resize(sloping_ ? desc_.robots.size() : 0);
  for (std::size_t r = 0; r < slopes_.size(); ++r) told_z_m_.push_back(bodies_[r].z_m);
  for (std::size_t i = desc_.robots.size(); i < bodies_.size(); ++i) {
    if (bodies_[i].z_m > floor_m(static_cast<int>(i))) support_[i] = kInAir;
  }
}

double Motion::floor_m(int body) const {
  if (!sloping_) return 0;
  const Pose2& p = bodies_[static_cast<std::size_t>(body)].pose;
  return desc_.ground->height_m({p.x_m, p.y_m});
}

void Motion::feel_ground() {
  for (std::size_t r = 0; r < slopes_.size(); ++r) {
    const RobotBody& body = desc_.robots[r];
    const Footing under = desc_.ground->footing(bodies_[r].pose, body.half_base_m, 0.5 * body.axle_m);
    slopes_[r] = slope_effect(under.slope, bodies_[r].pose.heading_rad, desc_.ground->down());
  }
}

SlopeEffect Motion::loose_slope(int body) const {
  const std::size_t i = static_cast<std::size_t>(body);
  const double base = 0.5 * desc_.solids[i]->bound_m;
  const Vec2 slope =
      support_[i] == kOnFloor ? desc_.ground->footing(bodies_[i].pose, base, base).slope : Vec2{};
  return slope_effect(slope, 0, desc_.ground->down());
}

/// After a tick's plane motion robots, and objects that lie on the ground, are as high as the ground.
void Motion::follow_ground() {
  for (int i = 0; i < static_cast<int>(bodies_.size()); ++i) {
    const std::size_t b = static_cast<std::size_t>(i);
    if (i >= robots()) {
      if (support_[b] != kOnFloor) continue;
      const double z = floor_m(i);
      if (z == bodies_[b].z_m) continue;
      // over an edge it falls
      if (z < bodies_[b].z_m - kLedgeM) {
        support_[b] = kInAir;
        continue;
      }
      bodies_[b].z_m = z;
      heights_changed(i);
      continue;
    }
    const RobotBody& body = desc_.robots[b];
    const double z = desc_.ground->footing(bodies_[b].pose, body.half_base_m, 0.5 * body.axle_m).height_m;
    bodies_[b].z_m = z;
    if (std::fabs(z - told_z_m_[b]) < kLedgeM) continue;
    told_z_m_[b] = z;
    heights_changed(i);
  }
}

double Motion::step(const RimTravel* travel, const Neighbours& neighbours) {
  // the largest move is found against the last poses, so that it includes every correction
  thread_local std::vector<Vec2> before;
  before.resize(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) before[i] = {bodies_[i].pose.x_m, bodies_[i].pose.y_m};
  if (sloping_) feel_ground();
  step_plane(travel, neighbours);
  step_heights();
  if (sloping_ && desc_.ground->has_ramps()) follow_ground();
  double most2 = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Vec2 moved = Vec2{bodies_[i].pose.x_m, bodies_[i].pose.y_m} - before[i];
    most2 = std::max(most2, dot(moved, moved));
  }
  return std::sqrt(most2);
}

Placed Motion::placed(int body) const {
  const BodyState& b = bodies_[static_cast<std::size_t>(body)];
  return {desc_.solids[static_cast<std::size_t>(body)], Frame2(b.pose), b.z_m};
}

void Motion::move(int body, const Pose2& pose, double z_m) {
  bodies_[static_cast<std::size_t>(body)] = {pose, z_m, {}, 0, 0};
  const double floor = floor_m(body);
  if (body >= robots()) {
    bodies_[static_cast<std::size_t>(body)].z_m = std::max(z_m, floor);
    support_[static_cast<std::size_t>(body)] = z_m > floor ? kInAir : kOnFloor;
  } else if (sloping_) {
    const RobotBody& robot = desc_.robots[static_cast<std::size_t>(body)];
    bodies_[static_cast<std::size_t>(body)].z_m =
        desc_.ground->footing(pose, robot.half_base_m, 0.5 * robot.axle_m).height_m;
  }
  heights_changed(body);
}

void Motion::set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s) {
  BodyState& b = bodies_[static_cast<std::size_t>(body)];
  b.velocity_m_s = velocity_m_s;
  b.spin_rad_s = spin_rad_s;
  if (body < robots()) return;
  int& support = support_[static_cast<std::size_t>(body)];
  if (climb_m_s > 0) support = kInAir;
  b.climb_m_s = support == kInAir ? climb_m_s : 0;
}

bool Motion::heights_meet(double z0_a, double z1_a, double z0_b, double z1_b) const {
  return std::min(z1_a, z1_b) - std::max(z0_a, z0_b) > kHeightOverlapM;
}

Motion::Wanted Motion::wanted(int robot, const RimTravel& travel) const {
  const Drive& d = drives_[static_cast<std::size_t>(robot)];
  const BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  double speed = 0.5 * (travel.left_m + travel.right_m) * ticks_per_s_;
  double spin = (travel.right_m - travel.left_m) * d.spin_per_m;
  if (sloping_) {
    speed *= slope_of(robot).way;
    spin *= slope_of(robot).turn;
  }
  if (speed == 0) return {{0, 0}, spin};
  // the direction is taken at the middle of the turn that friction will allow
  const double most = d.driving.spin_rad_s;
  const double allowed = b.spin_rad_s + std::clamp(spin - b.spin_rad_s, -most, most);
  const SinCos middle = sin_cos(b.pose.heading_rad + 0.5 * allowed * desc_.tick_s);
  return {{speed * middle.c, speed * middle.s}, spin};
}

void Motion::drive_freely(int robot, const Wanted& want) {
  const Drive& d = drives_[static_cast<std::size_t>(robot)];
  const Limits& limits = is_standing(want) ? d.standing : d.driving;
  BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  const double tick_s = desc_.tick_s;
  double most_spin = limits.spin_rad_s, most = limits.speed_m_s;
  Vec2 change = want.velocity_m_s - b.velocity_m_s;
  double size2 = dot(change, change);
  if (sloping_) {
    // gravity's pull comes first; grip then does what it can about it, measured along the slope
    const SlopeEffect& slope = slope_of(robot);
    b.velocity_m_s = b.velocity_m_s + (desc_.gravity_m_s2 * tick_s) * slope.pull;
    change = want.velocity_m_s - b.velocity_m_s;
    const double along = surface_length(slope, change);
    size2 = along * along;
    most *= slope.press;
    most_spin *= slope.press;
  }
  b.spin_rad_s += std::clamp(want.spin_rad_s - b.spin_rad_s, -most_spin, most_spin);
  if (size2 <= most * most) {
    b.velocity_m_s = want.velocity_m_s;
  } else {
    b.velocity_m_s = b.velocity_m_s + (most / std::sqrt(size2)) * change;
  }
  b.pose.x_m += b.velocity_m_s.x * tick_s;
  b.pose.y_m += b.velocity_m_s.y * tick_s;
  b.pose.heading_rad += b.spin_rad_s * tick_s;
}

void Motion::note_touch(int robot, bool wall, bool anything) {
  TouchReport& report = touches_[static_cast<std::size_t>(robot)];
  Touching& now = touch_times_[static_cast<std::size_t>(robot)];
  const double tick_s = desc_.tick_s;
  now.any_gap_s = anything ? 0 : std::min(1.0, now.any_gap_s + tick_s);
  now.wall_gap_s = wall ? 0 : std::min(1.0, now.wall_gap_s + tick_s);
  if (anything && now.any_s == 0) ++report.collisions;
  now.any_s = now.any_gap_s < kTouchGapS ? now.any_s + tick_s : 0;
  report.wall_touch_s = now.wall_gap_s < kTouchGapS ? report.wall_touch_s + tick_s : 0;
  report.longest_touch_s = std::max(report.longest_touch_s, now.any_s);
  report.longest_wall_touch_s = std::max(report.longest_wall_touch_s, report.wall_touch_s);
}

void Motion::push_out(int robot, const Neighbours& neighbours) {
  BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  const Solid& me = *desc_.solids[static_cast<std::size_t>(robot)];
  for (const Candidate* c = neighbours.begin(robot); c != neighbours.end(robot); ++c) {
    if (c->moving && c->index >= robots()) continue;  // loose objects give way by themselves
    const Placed other = c->moving ? placed(c->index) : (*desc_.fixed)[static_cast<std::size_t>(c->index)];
    if (!heights_meet(b.z_m + me.z0_m, b.z_m + me.z1_m, other.z_m + other.solid->z0_m,
                      other.z_m + other.solid->z1_m)) {
      continue;
    }
    Vec2 out;
    // a hair of overlap is left, or the solver would not see the contact
    const double gap = plan_distance_m({b.pose.x_m, b.pose.y_m}, other, &out) - me.bound_m + kContactDepthM;
    if (gap >= 0) continue;
    const double part = c->moving ? -0.5 * gap : -gap;
    b.pose.x_m += part * out.x;
    b.pose.y_m += part * out.y;
    if (!c->moving) continue;
    BodyState& they = bodies_[static_cast<std::size_t>(c->index)];
    they.pose.x_m -= part * out.x;
    they.pose.y_m -= part * out.y;
  }
}

bool Motion::blocked_at(int body, double z_m, int& by) const {
  Placed me = placed(body);
  me.z_m = z_m;
  const auto meets = [&](const Placed& other) {
    const Vec2 gap = other.frame.at - me.frame.at;
    const double reach = other.solid->bound_m + me.solid->bound_m;
    return dot(gap, gap) <= reach * reach && other.z_m + other.solid->z1_m > z_m &&
           overlaps(me, other, kRestSlackM);
  };
  for (const Placed& other : *desc_.fixed) {
    if (meets(other)) {
      by = kOnFixed;
      return true;
    }
  }
  for (int other = 0; other < static_cast<int>(bodies_.size()); ++other) {
    if (other != body && meets(placed(other))) {
      by = other;
      return true;
    }
  }
  return false;
}

void Motion::step_heights() {
  const double tick_s = desc_.tick_s;
  for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) {
    int& support = support_[static_cast<std::size_t>(i)];
    if (support == kOnFloor) continue;
    BodyState& b = bodies_[static_cast<std::size_t>(i)];
    // still carried? then it stays; a supporter that moved away lets it fall
    if (support != kInAir) {
      int by = 0;
      if (blocked_at(i, b.z_m - 3 * kRestSlackM, by)) {
        support = by;
        continue;
      }
      support = kInAir;
    }
    const double bounce = desc_.loose[static_cast<std::size_t>(i - robots())].restitution;
    const double from = b.z_m;
    const double floor = floor_m(i);
    double to = from + (b.climb_m_s - 0.5 * desc_.gravity_m_s2 * tick_s) * tick_s;
    b.climb_m_s -= desc_.gravity_m_s2 * tick_s;
    int by = kOnFloor;
    bool landed = to <= floor;
    if (landed) to = floor;
    int hit = 0;
    int ignored = 0;
    // a body that already shares space (it slid into a stack) is let through; it ends on the floor or on top
    if (b.climb_m_s < 0 && blocked_at(i, to, hit) && !blocked_at(i, from, ignored)) {
      double above = from, below = to;
      for (int round = 0; round < 24; ++round) {
        const double middle = 0.5 * (above + below);
        (blocked_at(i, middle, ignored) ? below : above) = middle;
      }
      to = above;
      by = hit;
      landed = true;
    }
    b.z_m = to;
    if (landed) {
      const double up = -bounce * b.climb_m_s;
      b.climb_m_s = up > kLandingMS ? up : 0;
      support = up > kLandingMS ? kInAir : by;
    }
    heights_changed(i);
  }
}

}  // namespace sim
