// SPDX-License-Identifier: MIT
// How long 65 frames of the converter's scan take beside a tick of the agendas. The converter stands from
// each sequence's end until its handler has listed the next channels, so a handler that waits for Timer 2's
// lengthens the frame. Three frames take a little less than two ticks: where the tick's handler takes more
// than what is missing, the two fall into step, and every third frame waits.
#pragma once
#include "hal_sim/api/call_cycles.h"

namespace api {

class ScanRhythm {
 public:
  explicit ScanRhythm(const CallCycles& cycles) : cycles_(cycles) {}
  /// 65 frames, on average, while each tick takes `tick_cycles`; 0: there are none.
  Cycle round(Cycle tick_cycles);

 private:
  Cycle found(Cycle tick_cycles) const;

  const CallCycles& cycles_;
  Cycle last_tick_ = 0, last_round_ = 0;  // asked last
};

}  // namespace api
