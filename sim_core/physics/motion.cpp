// SPDX-License-Identifier: MIT
// What the engines share: wheels to wanted speeds, free motion, touches. Heights: heights.cpp.
#include "sim_core/physics/motion.h"

#include <algorithm>
#include <cmath>

#include "sim_core/base/check.h"

namespace sim {

Motion::Motion(MotionDesc desc, bool has_heights, bool loose_moves, bool follows_wheels)
    : desc_(std::move(desc)),
      tick_s_(to_seconds(desc_.tick)),
      touch_gap_(std::max(from_seconds(kTouchGapS), kTouchGapTicks * desc_.tick + 1)),
      bodies_(desc_.start),
      before_(bodies_.size()),
      at_(bodies_.size(), desc_.begin),
      nearness_(desc_.robots.size(), Near::Nothing),
      begin_(desc_.begin),
      end_(desc_.begin),
      has_heights_(has_heights),
      loose_moves_(loose_moves),
      follows_wheels_(follows_wheels) {
  CHECK(bodies_.size() == desc_.solids.size() && bodies_.size() == desc_.robots.size() + desc_.loose.size(),
        "one start, one solid and one description per moving body");
  CHECK(desc_.surfaces.size() == desc_.fixed->size(), "one surface per fixed solid");
  for (const RobotBody& r : desc_.robots) {
    const auto limits = [&](double grip_n) {
      return Limits{grip_n * tick_s_ / r.mass_kg, grip_n * 0.5 * r.axle_m * tick_s_ / r.inertia_kg_m2};
    };
    drives_.push_back({1 / r.axle_m, limits(r.traction_n), limits(r.hold_n)});
  }
  touches_.resize(desc_.robots.size());
  way_m_.resize(desc_.robots.size());
  fixed_pushes_.resize(desc_.robots.size());
  guessed_.assign(desc_.robots.size(), true);
  leg_until_.resize(desc_.robots.size());
  free_until_.resize(desc_.robots.size());
  support_.assign(bodies_.size(), kOnFloor);
  sloping_ = has_heights_ && desc_.ground && !desc_.ground->is_plain();
  fall_m_s2_ = sloping_ ? -desc_.ground->down().z * desc_.gravity_m_s2 : desc_.gravity_m_s2;
  if (!has_heights_) {
    for (BodyState& b : bodies_) b.z_m = b.climb_m_s = 0;
  }
  for (const BodyState& b : bodies_)
    legs_.push_back({desc_.begin, b.pose, b.velocity_m_s, b.spin_rad_s, false});
  slopes_.resize(sloping_ ? desc_.robots.size() : 0);
  for (std::size_t r = 0; r < slopes_.size(); ++r) told_z_m_.push_back(bodies_[r].z_m);
  for (std::size_t i = desc_.robots.size(); i < bodies_.size(); ++i) {
    if (bodies_[i].z_m > floor_m(static_cast<int>(i))) support_[i] = kInAir;
  }
}

/// What the ground does to every robot in the tick.
void Motion::feel_ground() {
  for (std::size_t r = 0; r < slopes_.size(); ++r) {
    const RobotBody& body = desc_.robots[r];
    const Footing under = desc_.ground->footing(bodies_[r].pose, body.half_base_m, 0.5 * body.axle_m);
    slopes_[r] = slope_effect(under.slope, bodies_[r].pose.heading_rad, desc_.ground->down());
  }
}

void Motion::step(Clicks end, const std::vector<int>& active, const RimCourse* rims,
                  const Neighbours& neighbours) {
  begin_ = end - desc_.tick;
  end_ = end;
  rims_ = rims;
  near_.clear();
  changed_.clear();
  for (int r : active) {
    bring(r, begin_);
    const std::size_t i = static_cast<std::size_t>(r);
    before_[i] = {bodies_[i].pose.x_m, bodies_[i].pose.y_m};
  }
  if (sloping_) feel_ground();
  for (int r : active) {
    if (free_until_[static_cast<std::size_t>(r)] < end) look_around(r, neighbours);
    if (near(r) != Near::Nothing) near_.push_back(r);
  }
  // who has room follows the leg that was foreseen, or another one when the wheels turned otherwise
  for (int r : active) {
    const std::size_t i = static_cast<std::size_t>(r);
    if (near(r) != Near::Nothing) continue;
    if (guessed_[i] || rims[i].is_news) {
      drive_freely(r, wanted(r));
    } else {
      bring(r, end);
    }
  }
  const bool loose_too = !near_.empty() || is_loose_busy();
  if (loose_too) {
    for (std::size_t i = desc_.robots.size(); i < bodies_.size(); ++i)
      before_[i] = {bodies_[i].pose.x_m, bodies_[i].pose.y_m};
    const bool carried = std::any_of(support_.begin(), support_.end(), [](int s) { return s != kOnFloor; });
    for (int r = 0; r < robots() && carried; ++r)
      if (near(r) == Near::Nothing) bring(r, end);
    for (int r : near_)
      for (const Candidate* c = neighbours.begin(r); c != neighbours.end(r); ++c)
        if (c->moving && c->index < robots() && near(c->index) == Near::Nothing) bring(c->index, end);
    step_plane(neighbours);
  }
  if (loose_moves_ && sloping_ && desc_.ground->has_ramps()) follow_bends(active, loose_too);
  if (loose_too) {
    if (has_heights_) step_heights();
  }
  if (sloping_ && desc_.ground->has_ramps()) follow_ground();
  for (int r : active) {
    const std::size_t i = static_cast<std::size_t>(r);
    at_[i] = end;
    const bool guess = sloping_ || near(r) != Near::Nothing;
    if (!guess && !guessed_[i] && !rims[i].is_news && leg_until_[static_cast<std::size_t>(r)] >= end)
      continue;
    const BodyState& b = bodies_[i];
    const Leg& last = legs_[i];
    way_m_[i] += length(last.velocity_m_s) * to_seconds(begin_ - last.from) +
                 length(Vec2{b.pose.x_m, b.pose.y_m} - before_[i]);
    const Leg leg = guess ? Leg{end, b.pose, b.velocity_m_s, b.spin_rad_s, false}
                          : free_leg(r, end, wanted(r, rims[i].next));
    guessed_[i] = guess;
    leg_until_[static_cast<std::size_t>(r)] = leg.is_arc ? kEver : end;
    begin_leg(r, leg);
  }
  if (loose_too) begin_loose_legs();
}

void Motion::begin_leg(int body, const Leg& leg) {
  legs_[static_cast<std::size_t>(body)] = leg;
  changed_.push_back(body);
}

void Motion::begin_loose_legs() {
  for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) {
    const BodyState& b = bodies_[static_cast<std::size_t>(i)];
    at_[static_cast<std::size_t>(i)] = end_;
    begin_leg(i, {end_, b.pose, b.velocity_m_s, b.spin_rad_s, false});
  }
}

/// Brings a body's state up to an instant on its leg.
__attribute__((always_inline)) inline void Motion::bring(int body, Clicks at) {
  const std::size_t i = static_cast<std::size_t>(body);
  if (at_[i] == at) return;
  const Leg& leg = legs_[i];
  at_[i] = at;
  bodies_[i].pose = leg.pose_at(at);
  bodies_[i].velocity_m_s = leg.velocity_at(at - desc_.tick / 2);
  bodies_[i].spin_rad_s = leg.spin_rad_s;
}

void Motion::follow(int robot, const Leg& leg) {
  BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  b.pose = leg.pose_at(leg.from + desc_.tick);
  b.velocity_m_s = leg.velocity_at(leg.from + desc_.tick / 2);
  b.spin_rad_s = leg.spin_rad_s;
}

bool Motion::is_loose_busy() const {
  if (desc_.loose.empty()) return false;
  return sloping_ || is_loose_moving() ||
         std::any_of(support_.begin(), support_.end(), [](int s) { return s != kOnFloor && s != kOnFixed; });
}

void Motion::look_around(const Neighbours& neighbours, double pace_m_s, Clicks at) {
  pace_m_s_ = pace_m_s;
  // two bodies may approach each other, and a push may make one faster than both were
  const double most = pace_m_s * tick_s_;
  for (int r = 0; r < robots(); ++r) {
    const double room_s = (neighbours.clearance_m(r) - kSolverMarginM - most) / (2 * pace_m_s);
    free_until_[static_cast<std::size_t>(r)] = room_s > 0 ? at + from_seconds(std::min(room_s, 1.0)) : at;
  }
}

void Motion::look_around(int robot, const Neighbours& neighbours) {
  const BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  const Solid& me = *desc_.solids[static_cast<std::size_t>(robot)];
  const Vec2 place{b.pose.x_m, b.pose.y_m};
  double fixed = 1, moving = 1;
  for (const Candidate* c = neighbours.begin(robot); c != neighbours.end(robot); ++c) {
    if (c->moving) {
      const std::size_t o = static_cast<std::size_t>(c->index);
      const Pose2 there = at_[o] == begin_ ? bodies_[o].pose : legs_[o].pose_at(begin_);
      moving = std::min(moving, plan_distance_m(place, placed_at(*desc_.solids[o], there, bodies_[o].z_m)));
      continue;
    }
    const Placed& other = (*desc_.fixed)[static_cast<std::size_t>(c->index)];
    if (!has_heights_ || sloping_ ||
        heights_meet(b.z_m + me.z0_m, b.z_m + me.z1_m, other.z_m + other.solid->z0_m,
                     other.z_m + other.solid->z1_m)) {
      fixed = std::min(fixed, plan_distance_m(place, other));
    }
  }
  const double most = pace_m_s_ * tick_s_;
  const double room_m =
      std::min(fixed - me.bound_m - kSolverMarginM, 0.5 * (moving - me.bound_m - kSolverMarginM - most));
  free_until_[static_cast<std::size_t>(robot)] =
      begin_ + (room_m > 0 ? from_seconds(std::min(1.0, room_m / pace_m_s_)) : 0);
  const double gap_m = moving - me.bound_m;
  nearness_[static_cast<std::size_t>(robot)] = free_until_[static_cast<std::size_t>(robot)] >= end_
                                                   ? Near::Nothing
                                               : gap_m < kMeetingM                 ? Near::Meets
                                               : gap_m < kSolverMarginM + 3 * most ? Near::Bodies
                                                                                   : Near::Fixed;
}

Placed Motion::placed(int body) const {
  const BodyState& b = bodies_[static_cast<std::size_t>(body)];
  return {desc_.solids[static_cast<std::size_t>(body)], Frame2(b.pose), b.z_m};
}

void Motion::move(int body, const Pose2& pose, double z_m) {
  const std::size_t i = static_cast<std::size_t>(body);
  if (body < robots()) {
    way_m_[i] = distance_m(body);
    leg_until_[static_cast<std::size_t>(body)] = end_;
    guessed_[i] = true;
    // of where it was
    nearness_[i] = Near::Nothing;
    fixed_pushes_[i] = FixedPush{};
  }
  legs_[i] = {end_, pose, {}, 0, false};
  at_[i] = end_;
  bodies_[i] = {pose, has_heights_ ? z_m : 0, {}, 0, 0};
  if (!has_heights_) return;
  const double floor = floor_m(body);
  if (body >= robots()) {
    bodies_[i].z_m = std::max(z_m, floor);
    support_[i] = z_m > floor ? kInAir : kOnFloor;
  } else if (sloping_) {
    const RobotBody& robot = desc_.robots[i];
    bodies_[i].z_m = desc_.ground->footing(pose, robot.half_base_m, 0.5 * robot.axle_m).height_m;
  }
  heights_changed(body);
}

void Motion::set_velocity(int body, Vec2 velocity_m_s, double spin_rad_s, double climb_m_s) {
  const std::size_t i = static_cast<std::size_t>(body);
  BodyState& b = bodies_[i];
  const bool loose = body >= robots();
  if (!loose || loose_moves_) {
    if (!loose) {
      bring(body, end_);
      way_m_[i] = distance_m(body);
      leg_until_[static_cast<std::size_t>(body)] = end_;
      guessed_[i] = true;
    }
    b.velocity_m_s = velocity_m_s;
    b.spin_rad_s = spin_rad_s;
    at_[i] = end_;
    legs_[i] = {end_, b.pose, velocity_m_s, spin_rad_s, false};
  }
  if (!loose || !has_heights_) return;
  int& support = support_[i];
  if (climb_m_s > 0) support = kInAir;
  b.climb_m_s = support == kInAir ? climb_m_s : 0;
}

bool Motion::heights_meet(double z0_a, double z1_a, double z0_b, double z1_b) const {
  return std::min(z1_a, z1_b) - std::max(z0_a, z0_b) > kHeightOverlapM;
}

Motion::Wanted Motion::wanted(int robot, const RimSpeed& rims) const {
  const Drive& d = drives_[static_cast<std::size_t>(robot)];
  const BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  double speed = 0.5 * (rims.left_m_s + rims.right_m_s);
  double spin = (rims.right_m_s - rims.left_m_s) * d.spin_per_m_s;
  if (sloping_) {
    speed *= slope_of(robot).way;
    spin *= slope_of(robot).turn;
  }
  if (speed == 0) return {{0, 0}, spin, 0};
  // the direction is taken at the middle of the turn that friction will allow
  const double most = follows_wheels_ ? std::fabs(spin - b.spin_rad_s) : d.driving.spin_rad_s;
  const double allowed = b.spin_rad_s + std::clamp(spin - b.spin_rad_s, -most, most);
  const SinCos middle = sin_cos(b.pose.heading_rad + 0.5 * allowed * tick_s_);
  return {{speed * middle.c, speed * middle.s}, spin, speed};
}

Leg Motion::free_leg(int robot, Clicks from, const Wanted& want) const {
  const Drive& d = drives_[static_cast<std::size_t>(robot)];
  const Limits& limits = is_standing(want) ? d.standing : d.driving;
  const BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  double most_spin = limits.spin_rad_s, most = limits.speed_m_s;
  Vec2 velocity = b.velocity_m_s, change = want.velocity_m_s - velocity;
  double size2 = dot(change, change);
  if (sloping_) {
    // gravity's pull comes first; grip then does what it can about it, measured along the slope
    const SlopeEffect& slope = slope_of(robot);
    velocity = velocity + (desc_.gravity_m_s2 * tick_s_) * slope.pull;
    change = want.velocity_m_s - velocity;
    const double along = surface_length(slope, change);
    size2 = along * along;
    most *= slope.press;
    most_spin *= slope.press;
  }
  const double spin_change = want.spin_rad_s - b.spin_rad_s;
  const bool turns = follows_wheels_ || std::fabs(spin_change) <= most_spin;
  const bool grips = follows_wheels_ || size2 <= most * most;
  if (turns && grips && !sloping_) {
    const SinCos ahead = sin_cos(b.pose.heading_rad);
    return {from, b.pose, {want.speed_m_s * ahead.c, want.speed_m_s * ahead.s}, want.spin_rad_s, true};
  }
  velocity = grips ? want.velocity_m_s : velocity + (most / std::sqrt(size2)) * change;
  return {from, b.pose, velocity, b.spin_rad_s + std::clamp(spin_change, -most_spin, most_spin), false};
}

void Motion::note_touch(int robot, bool wall) {
  Touching& touching = touches_[static_cast<std::size_t>(robot)];
  TouchReport& report = touching.report;
  const auto go_on = [&](Touch& touch, double& longest_s) {
    const bool is_new = !lasts(touch);
    if (is_new) touch.first = begin_;
    touch.last = end_;
    longest_s = std::max(longest_s, touch.lasts_s());
    return is_new;
  };
  report.touch_s += tick_s_;
  if (go_on(touching.any, report.longest_touch_s)) ++report.collisions;
  if (wall) go_on(touching.wall, report.longest_wall_touch_s);
}

void Motion::carry_on(const Motion& before) {
  touches_ = before.touches_;
  for (int r = 0; r < robots(); ++r) way_m_[static_cast<std::size_t>(r)] = before.distance_m(r);
}

void Motion::forget_touches() {
  for (Touching& touching : touches_) touching.wall = touching.any = Touch{};
}

TouchReport Motion::touches(int robot) const {
  const Touching& touching = touches_[static_cast<std::size_t>(robot)];
  TouchReport report = touching.report;
  report.wall_touch_s = lasts(touching.wall) ? touching.wall.lasts_s() : 0;
  return report;
}

double Motion::distance_m(int robot) const {
  const Leg& leg = legs_[static_cast<std::size_t>(robot)];
  return way_m_[static_cast<std::size_t>(robot)] + length(leg.velocity_m_s) * to_seconds(end_ - leg.from);
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
