// SPDX-License-Identifier: MIT
// Where robots have been: whole ways for a picture, the last seconds for a film.
#pragma once
#include <cstddef>
#include <deque>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/pose.h"

namespace sim {

class Scene;

/// A robot that is farther from its last place after one tick was put there; its line is broken. Nothing here
/// drives 25 m/s.
inline constexpr double kJumpM = 0.05;

/// Collects every robot's way; drops points in between when there are very many.
class Trajectories {
 public:
  explicit Trajectories(int robots) : ways_(static_cast<std::size_t>(robots)), last_(ways_.size()) {}
  /// Call before the first step and after every step; keeps a point when a robot has moved by 1 mm.
  void sample(const Scene& scene);
  /// A robot was put somewhere else: its line is broken there. Jumps of more than kJumpM are seen anyway.
  void lift_pen(int robot);
  struct Way {
    std::vector<Vec2> points_m;
    std::vector<std::size_t> breaks;  ///< indices of points where a new line begins
  };
  const std::vector<Way>& ways() const { return ways_; }

 private:
  struct Last {
    Vec2 at_m;
    bool known = false;
  };
  std::vector<Way> ways_;
  std::vector<Last> last_;  // where each robot was at the last sample
};

/// The last seconds of every robot's way. Needs no more memory for a longer run.
class Trails {
 public:
  /// `span`: how far back a trail reaches, clicks; 0: no trails.
  Trails(int robots, Clicks span)
      : span_(span), trails_(static_cast<std::size_t>(robots)), lifted_(trails_.size()) {}
  /// Call before the first step and after every step.
  void sample(const Scene& scene);
  /// A robot was put somewhere else: its line is broken there. Jumps of more than kJumpM are seen anyway.
  void lift_pen(int robot) { lifted_[static_cast<std::size_t>(robot)] = true; }
  struct Point {
    Vec2 at_m;
    Clicks when = 0;
    bool lifted = false;  ///< a new line begins here
  };
  Clicks span() const { return span_; }
  /// Oldest first; a robot that stands leaves no further points.
  const std::deque<Point>& trail(int robot) const { return trails_[static_cast<std::size_t>(robot)]; }

 private:
  Clicks span_;
  std::vector<std::deque<Point>> trails_;
  std::vector<bool> lifted_;  // before the next point
};

}  // namespace sim
