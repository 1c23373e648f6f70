// SPDX-License-Identifier: MIT
// A round robot at walls, in closed form. In a tick the wheels push the robot towards the speed they ask for,
// by at most what grip allows. A fixed solid takes away the speed that would enter it before the tick's end,
// and its side rubs: the rim's sliding is slowed by at most the friction coefficient times that blow. Pushes
// and blows act on each other, so they are gone through in turn a few times, each keeping the sum of what it
// did within its limits. They begin with the sums of the tick before, so that what lasts settles exactly. The
// way of the tick is then straight.
#include <algorithm>
#include <array>
#include <cmath>

#include "sim_core/physics/motion.h"
#include "sim_core/physics/physics_params.h"

namespace sim {

namespace {

/// What the solid did in the tick before is where this one begins.
void begin_with(const FixedPush& before, FixedContact& contact) {
  contact.blow_m_s = contact.rub_m_s = 0;
  for (std::size_t k = 0; k < before.count; ++k) {
    if (before.contacts[k].solid != contact.solid) continue;
    contact.blow_m_s = before.contacts[k].blow_m_s;
    contact.rub_m_s = before.contacts[k].rub_m_s;
  }
}

/// A solid rubs, by as much as its blow lets it, and gives the blow that keeps a robot of that radius out.
/// `turn_per_rub`: rad/s for 1 m/s. False: it did all that before.
bool press(FixedContact& c, double bound_m, double turn_per_rub, Vec2& velocity, double& spin) {
  const Vec2 along{-c.normal.y, c.normal.x};
  const double most = c.friction * c.blow_m_s;
  const double sliding = dot(velocity, along) - bound_m * spin;
  const double rub = std::clamp(c.rub_m_s - sliding / (1 + bound_m * turn_per_rub), -most, most);
  velocity = velocity + (rub - c.rub_m_s) * along;
  spin -= turn_per_rub * (rub - c.rub_m_s);
  const double blow = std::max(0.0, c.blow_m_s + c.least_m_s - dot(velocity, c.normal));
  velocity = velocity + (blow - c.blow_m_s) * c.normal;
  const bool is_news = rub != c.rub_m_s || blow != c.blow_m_s;
  c.rub_m_s = rub;
  c.blow_m_s = blow;
  return is_news;
}

}  // namespace

void Motion::meet_fixed(int robot, const Neighbours& neighbours) {
  const RobotBody& body = desc_.robots[static_cast<std::size_t>(robot)];
  BodyState& b = bodies_[static_cast<std::size_t>(robot)];
  const Solid& me = *desc_.solids[static_cast<std::size_t>(robot)];
  FixedPush& last = fixed_pushes_[static_cast<std::size_t>(robot)];
  const FixedPush before = last.end == begin_ ? last : FixedPush{};
  std::array<FixedContact, kMostFixedContacts>& contacts = last.contacts;
  std::size_t count = 0;
  bool is_inside = false;
  // Solids that it may reach in this tick, with how fast it may come nearer, and how much their side rubs.
  for (const Candidate* c = neighbours.begin(robot); c != neighbours.end(robot); ++c) {
    if (c->moving || count == kMostFixedContacts) continue;
    const Placed& other = (*desc_.fixed)[static_cast<std::size_t>(c->index)];
    FixedContact& contact = contacts[count];
    const double gap =
        plan_distance_m({b.pose.x_m, b.pose.y_m}, other, &contact.normal) - me.bound_m + kContactDepthM;
    if (gap > kSolverMarginM + pace_m_s_ * tick_s_ ||
        !heights_meet(b.z_m + me.z0_m, b.z_m + me.z1_m, other.z_m + other.solid->z0_m,
                      other.z_m + other.solid->z1_m)) {
      continue;
    }
    is_inside = is_inside || gap < -kContactDepthM;
    const FixedSurface& surface = desc_.surfaces[static_cast<std::size_t>(c->index)];
    contact.least_m_s = -std::max(0.0, gap) / tick_s_;
    const double approach = -dot(b.velocity_m_s, contact.normal);
    if (surface.restitution > 0 && approach > kLeastBounceMS && approach > -contact.least_m_s)
      contact.least_m_s = surface.restitution * approach;
    contact.friction = std::sqrt(body.side_friction * surface.friction);
    contact.solid = c->index;
    begin_with(before, contact);
    ++count;
  }

  // The tick begins with the pushes and blows of the one before.
  const Wanted want = wanted(robot);
  if (count == 0) return drive_freely(robot, want);
  const Drive& d = drives_[static_cast<std::size_t>(robot)];
  const Limits& limits = is_standing(want) ? d.standing : d.driving;
  const double turn_per_rub = me.bound_m * body.mass_kg / body.inertia_kg_m2;  // rad/s for 1 m/s
  Vec2 push = before.push_m_s, velocity = b.velocity_m_s + push;
  double twist = before.twist_rad_s, spin = b.spin_rad_s + twist;
  for (std::size_t k = 0; k < count; ++k) {
    const FixedContact& c = contacts[k];
    velocity = velocity + c.blow_m_s * c.normal + c.rub_m_s * Vec2{-c.normal.y, c.normal.x};
    spin -= turn_per_rub * c.rub_m_s;
  }
  bool is_settled = false;
  for (int round = 0; round < kVelocityIterations && !is_settled; ++round) {
    const Vec2 came = velocity;
    const double came_spin = spin;
    // The wheels push towards what they want, turning and driving, within what grip allows.
    const double twisted = std::clamp(twist + want.spin_rad_s - spin, -limits.spin_rad_s, limits.spin_rad_s);
    is_settled = twisted == twist;
    spin += twisted - twist;
    twist = twisted;
    Vec2 pushed = push + want.velocity_m_s - velocity;
    const double size = length(pushed);
    if (size > limits.speed_m_s) pushed = (limits.speed_m_s / size) * pushed;
    is_settled = is_settled && pushed == push;
    velocity = velocity + pushed - push;
    push = pushed;
    bool is_hit = false;
    for (std::size_t k = 0; k < count; ++k) {
      if (press(contacts[k], me.bound_m, turn_per_rub, velocity, spin)) is_settled = false;
      is_hit = is_hit || contacts[k].blow_m_s > 0;
    }
    if (!is_hit && !is_inside) {
      drive_freely(robot, want);  // nothing was met: the closed form holds exactly
      return;
    }
    // what a round leaves as it found it stays so
    is_settled = is_settled && velocity == came && spin == came_spin;
  }
  // The way of the tick, and what the next one begins with.
  last.end = end_;
  last.count = count;
  last.push_m_s = push;
  last.twist_rad_s = twist;
  b.pose.x_m += velocity.x * tick_s_;
  b.pose.y_m += velocity.y * tick_s_;
  b.pose.heading_rad += spin * tick_s_;
  b.velocity_m_s = velocity;
  b.spin_rad_s = spin;
  note_touch(robot, true);
  if (is_inside) push_out(robot, neighbours);
}

}  // namespace sim
