// SPDX-License-Identifier: MIT
// What the engines share: wheels to wanted speeds, free motion, touches. Heights: heights.cpp.
#include "sim_core/physics/motion.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"
#include "sim_core/physics/physics_params.h"

namespace sim {

Motion::Motion(MotionDesc desc, bool has_heights, bool loose_moves)
    : desc_(std::move(desc)),
      bodies_(desc_.start),
      before_(bodies_.size()),
      has_heights_(has_heights),
      loose_moves_(loose_moves) {
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
  sloping_ = has_heights_ && desc_.ground && !desc_.ground->is_plain();
  fall_m_s2_ = sloping_ ? -desc_.ground->down().z * desc_.gravity_m_s2 : desc_.gravity_m_s2;
  if (!has_heights_) {
    for (BodyState& b : bodies_) b.z_m = b.climb_m_s = 0;
  }
  slopes_.resize(sloping_ ? desc_.robots.size() : 0);
  for (std::size_t r = 0; r < slopes_.size(); ++r) told_z_m_.push_back(bodies_[r].z_m);
  for (std::size_t i = desc_.robots.size(); i < bodies_.size(); ++i) {
    if (bodies_[i].z_m > floor_m(static_cast<int>(i))) support_[i] = kInAir;
  }
}

void Motion::feel_ground() {
  for (std::size_t r = 0; r < slopes_.size(); ++r) {
    const RobotBody& body = desc_.robots[r];
    const Footing under = desc_.ground->footing(bodies_[r].pose, body.half_base_m, 0.5 * body.axle_m);
    slopes_[r] = slope_effect(under.slope, bodies_[r].pose.heading_rad, desc_.ground->down());
  }
}

double Motion::step(const RimTravel* travel, const Neighbours& neighbours) {
  // the largest move is found against the last poses, so that it includes every correction
  for (std::size_t i = 0; i < bodies_.size(); ++i) before_[i] = {bodies_[i].pose.x_m, bodies_[i].pose.y_m};
  if (sloping_) feel_ground();
  step_plane(travel, neighbours);
  if (has_heights_) step_heights();
  if (sloping_ && desc_.ground->has_ramps()) follow_ground();
  double most2 = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Vec2 moved = Vec2{bodies_[i].pose.x_m, bodies_[i].pose.y_m} - before_[i];
    most2 = std::max(most2, dot(moved, moved));
  }
  return std::sqrt(most2);
}

Placed Motion::placed(int body) const {
  const BodyState& b = bodies_[static_cast<std::size_t>(body)];
  return {desc_.solids[static_cast<std::size_t>(body)], Frame2(b.pose), b.z_m};
}

void Motion::move(int body, const Pose2& pose, double z_m) {
  bodies_[static_cast<std::size_t>(body)] = {pose, has_heights_ ? z_m : 0, {}, 0, 0};
  if (!has_heights_) return;
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
  const bool loose = body >= robots();
  if (!loose || loose_moves_) {
    b.velocity_m_s = velocity_m_s;
    b.spin_rad_s = spin_rad_s;
  }
  if (!loose || !has_heights_) return;
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
  if (anything) report.touch_s += tick_s;
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

}  // namespace sim
