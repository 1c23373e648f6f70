// SPDX-License-Identifier: MIT
// One robot's oscillator seen from the world's clock. The robot counts instruction cycles from the moment its
// processor starts (world time 0 plus the boot delay); its crystal is off by a fixed number of parts per
// billion. Conversions are exact rationals in integers: monotone, without drift, the same on every machine.
// A robot that begins again counts on, and starts its processor anew: each stretch keeps its own beginning.
// Somebody may change the crystal's error between two ticks; what has passed stays as it was.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "hal_sim/board/cycle.h"
#include "sim_core/base/clock.h"

namespace board {

class RobotClock {
 public:
  /// `ppb`: parts per billion the robot's clock is fast (positive) or slow; above
  /// -1,000,000,000; 1,000,000,000 is twice as fast.
  /// `boot_clicks`: world time at which cycle 0 begins; not negative.
  explicit RobotClock(std::int64_t ppb = 0, sim::Clicks boot_clicks = 0)
      : ppb_(ppb), boot_(boot_clicks), boot_delay_(boot_clicks) {}

  /// At world time `at` the robot is as at world time 0; its cycles count on. Not before the last beginning.
  void begin_again(sim::Clicks at) {
    const Cycle first = std::max<Cycle>(0, cycle_at(at));
    past_.push_back({begun_, boot_, first_, ppb_});
    begun_ = at;
    boot_ = at + boot_delay_;
    first_ = first;
  }

  /// From world time `at` on the crystal is off by so much; not before the last change. Cycles count on: less
  /// than one is lost.
  void set_ppb(std::int64_t ppb, sim::Clicks at) {
    if (ppb == ppb_) return;
    if (at <= boot_) {  // it has not begun to count
      ppb_ = ppb;
      return;
    }
    const Cycle first = cycle_at(at);
    past_.push_back({begun_, boot_, first_, ppb_});
    begun_ = boot_ = at;
    first_ = first;
    ppb_ = ppb;
  }

  /// Last cycle that has begun at world time `at`; negative before the robot has booted for the first time.
  Cycle cycle_at(sim::Clicks at) const {
    const sim::Clicks since = at - boot_;
    if (begun_ > 0) {
      if (at < begun_) return before(at).cycle_at(at);
      if (since < 0) return first_;  // it boots again
    }
    return ppb_ == 0 ? since + first_ : cycles_in(since) + first_;
  }

  /// First click at which cycle `cycle` has begun: cycle_at(click_at(c)) >= c, and click_at(cycle_at(t)) <=
  /// t while it does not boot again.
  __attribute__((always_inline)) sim::Clicks click_at(Cycle cycle) const {
    if (begun_ > 0 && cycle < first_) return click_before(cycle);
    return (ppb_ == 0 ? cycle - first_ : clicks_of(cycle - first_)) + boot_;
  }

  std::int64_t ppb() const { return ppb_; }

 private:
  struct Stretch {
    sim::Clicks begun, boot;
    Cycle first;
    std::int64_t ppb;
  };
  RobotClock alone(const Stretch& stretch) const {
    RobotClock clock(stretch.ppb);
    clock.boot_ = stretch.boot;
    clock.first_ = stretch.first;
    return clock;
  }
  // questions about what is over are rare
  __attribute__((noinline)) sim::Clicks click_before(Cycle cycle) const {
    return std::min(begun_, before_cycle(cycle).click_at(cycle));
  }
  __attribute__((noinline)) RobotClock before(sim::Clicks at) const {
    std::size_t n = past_.size() - 1;
    while (n > 0 && at < past_[n].begun) --n;
    return alone(past_[n]);
  }
  __attribute__((noinline)) RobotClock before_cycle(Cycle cycle) const {
    std::size_t n = past_.size() - 1;
    while (n > 0 && cycle < past_[n].first) --n;
    return alone(past_[n]);
  }

  using Wide = __int128;
  static constexpr std::int64_t kBillion = 1'000'000'000;
  /// Of a span and a crystal within these the difference that the crystal makes is a division of 64 bits.
  static constexpr std::int64_t kShort = std::int64_t{1} << 40, kNearlyRight = 1 << 22;  // 20 h, 0.4 %

  template <typename Number>
  static std::int64_t floor_div(Number a, std::int64_t b) {
    Number q = a / b;
    if (a % b < 0) --q;
    return static_cast<std::int64_t>(q);
  }
  bool is_short(std::int64_t span) const {
    return span > -kShort && span < kShort && ppb_ > -kNearlyRight && ppb_ < kNearlyRight;
  }
  /// Whole cycles in a span of clicks, and whole clicks that so many cycles take at least.
  Cycle cycles_in(sim::Clicks span) const {
    if (is_short(span)) return span + floor_div(span * ppb_, kBillion);
    return floor_div(static_cast<Wide>(span) * (kBillion + ppb_), kBillion);
  }
  sim::Clicks clicks_of(Cycle cycles) const {
    if (is_short(cycles)) return cycles - floor_div(cycles * ppb_, kBillion + ppb_);
    return -floor_div(-static_cast<Wide>(cycles) * kBillion, kBillion + ppb_);
  }

  std::int64_t ppb_;
  sim::Clicks boot_;  // when cycle first_ begins
  sim::Clicks boot_delay_;
  sim::Clicks begun_ = 0;  // since when this holds
  Cycle first_ = 0;
  std::vector<Stretch> past_;
};

}  // namespace board
