// SPDX-License-Identifier: MIT
// One robot's oscillator seen from the world's clock. The robot counts instruction cycles from the moment its
// processor starts (world time 0 plus the boot delay); its crystal is off by a fixed number of parts per
// billion. Conversions are exact rationals in integers: monotone, without drift, the same on every machine.
// Not modelled: a crystal whose rate changes with temperature.
#pragma once
#include <cstdint>

#include "hal_sim/board/cycle.h"
#include "sim_core/base/clock.h"

namespace board {

class RobotClock {
 public:
  /// `ppb`: parts per billion the robot's clock is fast (positive) or slow; above
  /// -1,000,000,000; 1,000,000,000 is twice as fast.
  /// `boot_clicks`: world time at which cycle 0 begins; not negative.
  explicit RobotClock(std::int64_t ppb = 0, sim::Clicks boot_clicks = 0)
      : ppb_(ppb), boot_clicks_(boot_clicks) {}

  /// Last cycle that has begun at world time `at`; negative before the robot has booted.
  Cycle cycle_at(sim::Clicks at) const {
    const sim::Clicks since = at - boot_clicks_;
    if (ppb_ == 0) return since;
    return floor_div(static_cast<Wide>(since) * (kBillion + ppb_), kBillion);
  }

  /// First click at which cycle `cycle` has begun: cycle_at(click_at(c)) >= c, and click_at(cycle_at(t)) <=
  /// t.
  sim::Clicks click_at(Cycle cycle) const {
    if (ppb_ == 0) return cycle + boot_clicks_;
    return -floor_div(-static_cast<Wide>(cycle) * kBillion, kBillion + ppb_) + boot_clicks_;
  }

  std::int64_t ppb() const { return ppb_; }
  sim::Clicks boot_clicks() const { return boot_clicks_; }

 private:
  using Wide = __int128;
  static constexpr std::int64_t kBillion = 1'000'000'000;

  static std::int64_t floor_div(Wide a, std::int64_t b) {
    Wide q = a / b;
    if (a % b < 0) --q;
    return static_cast<std::int64_t>(q);
  }

  std::int64_t ppb_;
  sim::Clicks boot_clicks_;
};

}  // namespace board
