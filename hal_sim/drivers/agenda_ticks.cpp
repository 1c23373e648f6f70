// SPDX-License-Identifier: MIT
// See agenda_ticks.h. Invariant: outside a walk no tick at or after next_fire_ is processed.
#include "hal_sim/drivers/agenda_ticks.h"

namespace drivers {

std::int64_t AgendaTicks::at(Cycle at) const {
  if (walking_) return walk_tick_;
  if (!running_) return stopped_tick_;
  if (held_since_ >= 0 && has_no_flag_) return held_done_;
  if (held_since_ >= 0) at = std::min(at, held_since_);
  std::int64_t tick = came(0, at);
  if (tick < line_.late_tick) tick = at >= line_.late_cycle ? line_.late_tick : line_.late_tick - 1;
  if (tick == line_.late_tick && at < line_.late_cycle) tick = line_.late_tick - 1;
  // the handler is due: until it has begun, the interrupt is pending and nothing counts
  if (next_fire_ >= 0 && tick >= next_fire_) tick = next_fire_ - 1;
  return tick;
}

void AgendaTicks::start(Cycle at) {
  const std::int64_t tick = this->at(at);
  // a callback may do this: motors further down the list still belong to the tick that is being walked
  line_.late_cycle = line_.cycle_of(tick);
  line_.late_tick = walking_ ? tick : -1;
  line_.origin = at - tick * kAgendaTickCycles;
  running_ = true;
}

void AgendaTicks::reset() {
  const bool no_flag = has_no_flag_;
  *this = AgendaTicks{};
  has_no_flag_ = no_flag;
}

}  // namespace drivers
