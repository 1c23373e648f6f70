// SPDX-License-Identifier: MIT
// How fast the world runs beside the clock on the wall, and how fast it did.
#pragma once
#include <chrono>
#include <functional>
#include <utility>

#include "sim_core/base/clock.h"

namespace viewer {

class Pace {
 public:
  using Wall = std::chrono::steady_clock;
  using Clock = std::function<Wall::time_point()>;

  /// `wall`: the clock on the wall.
  explicit Pace(Clock wall = Wall::now) : wall_(std::move(wall)) {}

  bool plays() const { return plays_; }
  /// Simulated seconds a second; 0: as fast as possible.
  double speed() const { return speed_; }
  /// As it was measured over the last half second; 0 while it stands.
  double measured() const { return measured_; }

  void play(bool on, sim::Clicks now);
  void set_speed(double speed, sim::Clicks now);
  /// Another run, or another time of it.
  void begin(sim::Clicks now);
  /// Until when the world may run now; kEver: it is not held back. A machine that is too slow does not run
  /// after the time it lost.
  sim::Clicks due(sim::Clicks now);
  /// Real seconds until `now` is due.
  double wait_s(sim::Clicks now) const;
  void measure(sim::Clicks now);

 private:
  Clock wall_;
  bool plays_ = false;
  double speed_ = 1, measured_ = 0;
  Wall::time_point anchor_wall_{}, measured_wall_{};
  sim::Clicks anchor_ = 0, measured_from_ = 0;
};

}  // namespace viewer
