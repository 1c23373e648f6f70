// SPDX-License-Identifier: MIT
// One leg of a body's way: how it moves from an instant on until its next leg begins, in closed form. What
// nothing disturbs needs no work at any tick, and its pose at any instant is exact whoever asks.
#pragma once
#include <limits>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/pose.h"

namespace sim {

/// State of a moving body, at a tick.
struct BodyState {
  Pose2 pose;
  double z_m = 0;     ///< height of its origin (its underside) above the floor
  Vec2 velocity_m_s;  ///< world frame
  double spin_rad_s = 0;
  double climb_m_s = 0;  ///< vertical speed; negative while falling
};

/// Instants that never come.
inline constexpr Clicks kEver = std::numeric_limits<Clicks>::max() / 2;

struct Leg {
  Clicks from = 0;
  Pose2 pose;             ///< at `from`
  Vec2 velocity_m_s;      ///< at `from`, world frame
  double spin_rad_s = 0;  ///< constant
  bool is_arc = false;    ///< the velocity turns with the body, as wheels that grip make it

  Pose2 pose_at(Clicks at) const {
    const double s = to_seconds(at - from);
    Vec2 way = s * velocity_m_s;
    const double half_turn = 0.5 * spin_rad_s * s;
    if (is_arc && half_turn != 0) {
      // the chord of an arc lies half the turn away from its beginning
      const SinCos half = sin_cos(half_turn);
      const double chord = std::fabs(half_turn) < 1e-5 ? 1 : half.s / half_turn;
      way = chord * Vec2{half.c * way.x - half.s * way.y, half.s * way.x + half.c * way.y};
    }
    return {pose.x_m + way.x, pose.y_m + way.y, pose.heading_rad + spin_rad_s * s};
  }
  Vec2 velocity_at(Clicks at) const {
    if (!is_arc || spin_rad_s == 0) return velocity_m_s;
    const SinCos turn = sin_cos(spin_rad_s * to_seconds(at - from));
    return {turn.c * velocity_m_s.x - turn.s * velocity_m_s.y,
            turn.s * velocity_m_s.x + turn.c * velocity_m_s.y};
  }
};

}  // namespace sim
