// SPDX-License-Identifier: MIT
#include "hal_sim/api/scan_rhythm.h"

#include <algorithm>

#include "hal_sim/drivers/driver_params.h"

namespace api {

// both handlers have one priority: what is under way ends first, and of two that wait Timer 2's comes first
Cycle ScanRhythm::round(Cycle tick_cycles) {
  if (tick_cycles == 0) return cycles_.scan_round;
  // a handler that takes all time would leave the converter's none
  tick_cycles = std::min(tick_cycles, drivers::kAgendaTickCycles * 9 / 10);
  const auto [found, is_new] = known_.emplace(tick_cycles, 0);
  if (!is_new) return found->second;
  // in 65ths of a cycle, so that a frame is a whole number
  constexpr Cycle kUnit = drivers::kScanPeriod;
  constexpr int kSettle = 20 * drivers::kScanPeriod, kRounds = 20;
  const Cycle frame = cycles_.scan_round, handler = cycles_.share_scan_round,
              tick_handler = tick_cycles * kUnit;
  Cycle sequence_end = frame, tick = 0, free = 0, began = 0;
  for (int frames = 0; frames < kSettle + kRounds * drivers::kScanPeriod;) {
    if (tick <= std::max(sequence_end, free)) {
      free = std::max(tick, free) + tick_handler;
      tick += drivers::kAgendaTickCycles * kUnit;
      continue;
    }
    const Cycle start = std::max(sequence_end, free);
    free = start + handler;
    sequence_end = start + frame;
    if (++frames == kSettle) began = sequence_end;
  }
  return found->second = (sequence_end - began) / (kRounds * kUnit);
}

}  // namespace api
