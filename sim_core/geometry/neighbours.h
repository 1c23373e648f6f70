// SPDX-License-Identifier: MIT
// Who is near whom: fixed solids in a uniform grid, moving ones binned anew whenever they have moved far
// enough, and for each robot one list of everything its rays or its bumper could meet until then (a
// Verlet list). In: placed solids, positions, m. Out: candidate lists, clearances (m), first hit of a
// long ray. Algorithm: lists are gathered `kSkinM` too wide and hold until bodies may have used up the
// skin, twice their way; whoever knows how fast they are then asks for new ones. Lists are constant
// while robots' minds run.
#pragma once
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "sim_core/base/clock.h"
#include "sim_core/geometry/solid.h"

namespace sim {

/// Side of a grid cell, m. [measured: 0.2 m gave the fewest candidates and cell visits for 7 cm robots]
inline constexpr double kCellM = 0.20;
/// How much too wide lists are gathered, m. [measured: new lists seven times a second at a robot's full speed;
/// 0.04 m costs a robot alone 1 % more, 0.08 m a swarm as much]
inline constexpr double kSkinM = 0.06;

/// Something a ray or a body can meet. Fixed solids count from 0; moving ones from 0 in their own numbering.
struct Candidate {
  std::int32_t index = 0;
  bool moving = false;
};

class Neighbours {
 public:
  /// `fixed` must outlive this object and not move in memory. The first `robots` moving bodies are robots.
  /// reach_m[r]: how far from its centre robot r's rays can see.
  Neighbours(const std::vector<Placed>& fixed, std::vector<double> moving_bound_m, int robots,
             std::vector<double> reach_m);

  /// Bins the moving bodies where they are now and gathers every robot's list. `history_m`: how far any body
  /// has moved within the poses that readers may still ask for, or may be extrapolated. They are of `at`; no
  /// body is, or was in those poses, faster than `pace_m_s`.
  void rebuild(const std::vector<Placed>& moving, double history_m, double pace_m_s, Clicks at);

  /// Distance, m, that robot r had around its bound when the lists were gathered; negative: it
  /// may touch something.
  double clearance_m(int robot) const { return clearance_[static_cast<std::size_t>(robot)]; }

  /// False: so near to the instant of the lists nothing on robot r's comes within the reach of its rays; or
  /// not this one of them.
  bool may_see(int robot, Clicks at) const {
    return std::abs(at - at_) >= alone_for_[static_cast<std::size_t>(robot)];
  }
  bool may_see(const Candidate* listed, Clicks at) const {
    return std::abs(at - at_) >= far_for_[static_cast<std::size_t>(listed - list_.data())];
  }

  const Candidate* begin(int robot) const { return list_.data() + first_[static_cast<std::size_t>(robot)]; }
  const Candidate* end(int robot) const { return list_.data() + first_[static_cast<std::size_t>(robot) + 1]; }

  /// Fixed and moving solids that may stand within radius_m of a point, each once, fixed
  /// ones first, in order.
  void gather(Vec2 point, double radius_m, std::vector<Candidate>& out) const;

 private:
  int cell_x(double x) const;
  int cell_y(double y) const;

  const std::vector<Placed>& fixed_;
  std::vector<double> bound_m_;  // of moving bodies
  double largest_bound_m_ = 0;
  int robots_;
  std::vector<double> reach_m_;
  double x0_ = 0, y0_ = 0;
  int columns_ = 1, rows_ = 1;
  std::vector<std::int32_t> fixed_first_, moving_first_;  // per cell, one more than cells
  std::vector<std::int32_t> fixed_items_;
  std::vector<std::int32_t> moving_items_;
  std::vector<std::int32_t> cell_of_;
  std::vector<Vec2> place_;
  std::vector<double> clearance_;
  std::vector<std::int32_t> first_;
  std::vector<Candidate> list_;
  Clicks at_ = 0;
  std::vector<Clicks> alone_for_, far_for_;  // per robot, per entry of the list
};

}  // namespace sim
