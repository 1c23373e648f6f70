// SPDX-License-Identifier: MIT
// The CPU's level and the handlers under way: what holds interrupts off. DISI holds priorities 1 to 6; behind
// RETFIE one instruction runs before the next acceptance. Source: [chip C11].
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "dspic30/memory/cycle.h"
#include "dspic30/memory/sfr_table.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

inline constexpr std::uint16_t kMostDisi = sfr_bits("DISICNT", "DISICNT");

class CpuLevel {
 public:
  /// A handler under way.
  struct Frame {
    int vector;
    int outer_level;
    Cycle entered;
  };

  /// SR.IPL, and IPL3 above 7.
  int level() const { return level_; }
  /// Handlers entered and not yet left.
  int nesting() const { return depth_; }
  bool disi_active(Cycle now) const { return now < disi_until_; }
  Cycle disi_until() const { return disi_until_; }
  /// The lowest priority that is accepted at the boundary before `now`, by a CPU of that level.
  int lowest(Cycle now, int cpu_level) const {
    int lowest = cpu_level + 1;
    if (disi_active(now)) lowest = std::max(lowest, 7);
    if (now <= resumed_) lowest = std::max(lowest, resumed_level_ + 1);
    return lowest;
  }
  /// Earliest cycle > now, and <= `next`, at which it is another one by itself.
  Cycle horizon(Cycle now, Cycle next) const {
    if (disi_active(now)) next = std::min(next, disi_until_);
    if (now <= resumed_) next = std::min(next, resumed_ + 1);
    return std::max(next, now + 1);
  }

  // --- for the controller
  void set(int level) { level_ = level; }
  void disi(unsigned count, Cycle now) { disi_until_ = now + 1 + static_cast<Cycle>(count & kMostDisi); }
  void enter(int vector, int level, Cycle now) {
    if (depth_ == static_cast<int>(frames_.size())) make_room();
    frames_[static_cast<std::size_t>(depth_++)] = {vector, level_, now};
    level_ = level;
  }
  /// Some handler is under way. Returns it; the first instruction behind it comes at `resumed`.
  const Frame& leave(Cycle resumed) {
    const Frame& frame = frames_[static_cast<std::size_t>(--depth_)];
    resumed_ = resumed;
    resumed_level_ = std::min(level_, 7);
    level_ = frame.outer_level;
    return frame;
  }
  /// Behind leave(): to the level that the program's stack tells.
  void resume_at(int level, Cycle resumed) {
    resumed_ = resumed;
    level_ = level;
  }
  void reset() {
    level_ = depth_ = 0;
    disi_until_ = 0;
    resumed_ = -1;
  }

 private:
  static constexpr int kMostFrames = 64;
  __attribute__((noinline)) void make_room();

  int level_ = 0;
  int depth_ = 0;
  int resumed_level_ = 0;  // level of the handler that ended at resumed_
  Cycle resumed_ = -1;     // first instruction after RETFIE
  Cycle disi_until_ = 0;
  std::vector<Frame> frames_;  // of handlers under way, the innermost last; and room for more
};

}  // namespace dspic
