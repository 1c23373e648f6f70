// SPDX-License-Identifier: MIT
// Which LEDs of the robots are lit, for whoever looks at robots. In: those of a tick, once somebody watches.
// Looking is safe from any thread while nobody publishes.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <vector>

namespace sim {

class LitLeds {
 public:
  /// Of a robot at the last tick, bits as in MindReport; 0 as long as nobody watches.
  std::uint32_t of(int robot) const { return leds_.empty() ? 0 : leds_[static_cast<std::size_t>(robot)]; }
  /// From the next tick on they are published. Safe from any thread at any time.
  void watch() const { is_watched_.store(true, std::memory_order_relaxed); }
  bool is_watched() const { return is_watched_.load(std::memory_order_relaxed); }
  /// Those of all robots.
  void publish(const std::vector<std::uint32_t>& leds) { leds_ = leds; }
  /// All are dark until they are published again.
  void forget() { std::fill(leds_.begin(), leds_.end(), 0); }

 private:
  std::vector<std::uint32_t> leds_;  // per robot; empty until somebody watches
  mutable std::atomic<bool> is_watched_{false};
};

}  // namespace sim
