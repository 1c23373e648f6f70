// SPDX-License-Identifier: MIT
// See agenda_ticks.h. Invariant: outside a walk no tick at or after next_fire_ is processed.
#include "hal_sim/drivers/agenda_ticks.h"

namespace drivers {

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
