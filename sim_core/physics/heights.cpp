// SPDX-License-Identifier: MIT
// How high bodies are: robots follow the ground, loose objects fall, bounce, and rest on whatever is below.
// A fall is a parabola in closed form. A body that meets something within a tick does so at its instant,
// flies on for the rest of the tick and may meet it again, so that a drop from h0 with restitution e rises to
// e^2 h0, e^4 h0, ... at any tick rate. Impacts slower than kLeastBounceMS do not bounce: the body rests, and
// stays where it is to the last bit. On a slope the blow is along the slope's normal and changes the way in
// plan too; friction during the blow, spin and tumbling are not modelled.
#include <algorithm>
#include <cmath>

#include "sim_core/geometry/overlap.h"
#include "sim_core/physics/motion.h"
#include "sim_core/physics/physics_params.h"

namespace sim {

double Motion::floor_m(int body) const {
  if (!sloping_) return 0;
  const Pose2& p = bodies_[static_cast<std::size_t>(body)].pose;
  return desc_.ground->height_m({p.x_m, p.y_m});
}

SlopeEffect Motion::loose_slope(int body) const {
  const std::size_t i = static_cast<std::size_t>(body);
  const Vec2 slope = support_[i] == kOnFloor ? slope_under(body) : Vec2{};
  return slope_effect(slope, 0, desc_.ground->down());
}

Vec2 Motion::slope_under(int body) const {
  const std::size_t i = static_cast<std::size_t>(body);
  const double base = 0.5 * desc_.solids[i]->bound_m;
  return desc_.ground->footing(bodies_[i].pose, base, base).slope;
}

/// What rolls or slides over a bend of the ground keeps its speed along the surface: plan speeds change.
void Motion::follow_bends(const std::vector<int>& active, bool loose_too) {
  for (int r : active) {
    const RobotBody& body = desc_.robots[static_cast<std::size_t>(r)];
    if (!follows_wheels_) follow_bend(r, body.half_base_m, 0.5 * body.axle_m);
  }
  if (!loose_too) return;
  for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) {
    const double base = 0.5 * desc_.solids[static_cast<std::size_t>(i)]->bound_m;
    if (support_[static_cast<std::size_t>(i)] == kOnFloor) follow_bend(i, base, base);
  }
}

void Motion::follow_bend(int body, double half_length_m, double half_width_m) {
  const std::size_t i = static_cast<std::size_t>(body);
  BodyState& b = bodies_[i];
  const Pose2 before{before_[i].x, before_[i].y, b.pose.heading_rad};
  if (before.x_m == b.pose.x_m && before.y_m == b.pose.y_m) return;
  const Ground& ground = *desc_.ground;
  const Vec2 was = ground.footing(before, half_length_m, half_width_m).slope,
             is = ground.footing(b.pose, half_length_m, half_width_m).slope;
  if (was.x == is.x && was.y == is.y) return;
  // a kerb is no bend: who drives over its edge falls
  if (!ground.is_smooth(before, half_length_m, half_width_m) ||
      !ground.is_smooth(b.pose, half_length_m, half_width_m))
    return;
  b.velocity_m_s = behind_bend(b.velocity_m_s, was, is);
  if (body >= robots()) velocity_changed(body);
}

/// After a tick's plane motion robots, and objects that lie on the ground, are as high as the ground.
void Motion::follow_ground() {
  for (int i = 0; i < static_cast<int>(bodies_.size()); ++i) {
    const std::size_t b = static_cast<std::size_t>(i);
    if (i >= robots()) {
      if (support_[b] != kOnFloor) continue;
      const double z = floor_m(i);
      if (z == bodies_[b].z_m) continue;
      // over an edge it falls, down a slope it follows
      const Pose2& now = bodies_[b].pose;
      const double base = 0.5 * desc_.solids[b]->bound_m, way = length(Vec2{now.x_m, now.y_m} - before_[b]),
                   steep =
                       length(desc_.ground->footing({before_[b].x, before_[b].y, now.heading_rad}, base, base)
                                  .slope);
      if (z < bodies_[b].z_m - kLedgeM - steep * way) {
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

bool Motion::blocked_at(int body, double z_m, Below& by) const {
  Placed me = placed(body);
  me.z_m = z_m;
  const auto meets = [&](const Placed& other) {
    const Vec2 gap = other.frame.at - me.frame.at;
    const double reach = other.solid->bound_m + me.solid->bound_m;
    return dot(gap, gap) <= reach * reach && other.z_m + other.solid->z1_m > z_m &&
           overlaps(me, other, kRestSlackM);
  };
  for (std::size_t i = 0; i < desc_.fixed->size(); ++i) {
    if (meets((*desc_.fixed)[i])) {
      by = {kOnFixed, desc_.surfaces[i].restitution};
      return true;
    }
  }
  for (int other = 0; other < static_cast<int>(bodies_.size()); ++other) {
    if (other != body && meets(placed(other))) {
      by = {other, other < robots() ? 0 : loose(other).restitution};
      return true;
    }
  }
  return false;
}

void Motion::step_heights() {
  for (int i = robots(); i < static_cast<int>(bodies_.size()); ++i) {
    int& support = support_[static_cast<std::size_t>(i)];
    if (support == kOnFloor) continue;
    // still carried? then it stays; a supporter that moved away lets it fall
    if (support != kInAir) {
      Below under;
      if (blocked_at(i, bodies_[static_cast<std::size_t>(i)].z_m - 3 * kRestSlackM, under)) {
        support = under.body;
        continue;
      }
      support = kInAir;
    }
    fly(i);
    heights_changed(i);
  }
}

Motion::Landing Motion::landing_of(int body) {
  const std::size_t i = static_cast<std::size_t>(body);
  // Without anything below it lands on the floor.
  const BodyState& b = bodies_[i];
  const double tick_s = tick_s_, own = loose(body).restitution;
  const double end = b.z_m + (b.climb_m_s - 0.5 * fall_m_s2_ * tick_s) * tick_s;
  Landing landing;
  landing.restitution = own;
  landing.height_m = landing.end_m = floor_m(body);
  Below by, ignored;
  // a body that already shares space (it slid into a stack) is let through; it ends on the floor or on top
  const double lowest = std::max(end, landing.end_m);
  if (b.climb_m_s - fall_m_s2_ * tick_s < 0 && blocked_at(body, lowest, by) &&
      !blocked_at(body, b.z_m, ignored)) {
    double above = b.z_m, below = lowest;
    for (int round = 0; round < 24; ++round) {
      const double middle = 0.5 * (above + below);
      (blocked_at(body, middle, ignored) ? below : above) = middle;
    }
    landing.height_m = landing.end_m = above;
    landing.body = by.body;
    landing.restitution = std::max(own, by.restitution);  // the bouncier of the two, as at sides
    return landing;
  }
  if (!sloping_) return landing;
  // the ground under it rises or sinks as the body flies over it; a step up lifts it at once
  const Vec2 way = Vec2{b.pose.x_m, b.pose.y_m} - before_[i];
  landing.slope = slope_under(body);
  const double rise = dot(landing.slope, way);
  if (landing.end_m - desc_.ground->height_m(before_[i]) <= rise + kLedgeM) {
    landing.height_m -= rise;
    landing.climb_m_s = rise / tick_s;
  }
  // A ramp has a restitution of its own.
  double drop_m = kLedgeM;
  const int ramp =
      desc_.ground->cast({{b.pose.x_m, b.pose.y_m, landing.end_m + 0.5 * kLedgeM}, {0, 0, -1}}, drop_m);
  if (ramp >= 0 && static_cast<std::size_t>(ramp) < desc_.ramp_restitution.size()) {
    landing.restitution = std::max(own, desc_.ramp_restitution[static_cast<std::size_t>(ramp)]);
  }
  return landing;
}

void Motion::fly(int body) {
  const std::size_t i = static_cast<std::size_t>(body);
  BodyState& b = bodies_[i];
  const double g = fall_m_s2_;
  const Landing on = landing_of(body);
  const double steep2 = 1 / (1 + dot(on.slope, on.slope));
  double left_s = tick_s_, under = on.height_m;
  for (int bounce = 0; bounce < kMostBouncesPerTick; ++bounce) {
    // the instant of the next meeting: the height above what moves below is a parabola
    const double gap = std::max(0.0, b.z_m - under), closing = b.climb_m_s - on.climb_m_s;
    const double hit_speed = std::sqrt(closing * closing + 2 * g * gap);
    const double until_s = (closing + hit_speed) / g;
    if (until_s >= left_s) {
      b.z_m = std::max(b.z_m + (b.climb_m_s - 0.5 * g * left_s) * left_s, on.end_m);
      b.climb_m_s -= g * left_s;
      return;
    }
    left_s -= until_s;
    under += on.climb_m_s * until_s;
    b.z_m = under;
    // the blow: along the normal, whose share of a vertical speed is the cosine of the slope's angle
    const double normal_m_s = hit_speed * std::sqrt(steep2);
    const bool stays = normal_m_s < kLeastBounceMS || on.restitution == 0;
    const double factor = loose_moves_ ? steep2 : 1;  // what cannot move in the plane bounces straight up
    const double up = (1 + (stays ? 0 : on.restitution)) * hit_speed * factor;
    b.climb_m_s = on.climb_m_s - hit_speed + up;
    if (loose_moves_ && (on.slope.x != 0 || on.slope.y != 0)) {
      b.velocity_m_s = b.velocity_m_s - up * on.slope;
      velocity_changed(body);
    }
    if (stays) break;
    if (on.slope.x == 0 && on.slope.y == 0) continue;
    // the way in plan was worked out before the blow: the rest of this tick is flown from the ground's height
    b.z_m = on.end_m;
    return;
  }
  b.z_m = on.end_m;
  b.climb_m_s = 0;
  support_[i] = on.body;
}

}  // namespace sim
