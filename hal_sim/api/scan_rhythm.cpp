// SPDX-License-Identifier: MIT
#include "hal_sim/api/scan_rhythm.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "hal_sim/drivers/driver_params.h"

namespace api {

// both handlers have one priority: what is under way ends first, and of two that wait Timer 2's comes first
Cycle ScanRhythm::round(Cycle tick_cycles) {
  if (tick_cycles == 0) return cycles_.scan_round;
  // a handler that takes all time would leave the converter's none
  tick_cycles = std::min(tick_cycles, drivers::kAgendaTickCycles * 9 / 10);
  if (tick_cycles == last_tick_) return last_round_;
  // what one robot has found holds for all whose library was compiled alike
  static std::mutex mutex;
  static std::map<std::pair<const CallCycles*, Cycle>, Cycle> known;
  const std::lock_guard lock(mutex);
  const auto [place, is_new] = known.try_emplace({&cycles_, tick_cycles}, 0);
  if (is_new) place->second = found(tick_cycles);
  last_tick_ = tick_cycles;
  return last_round_ = place->second;
}

Cycle ScanRhythm::found(Cycle tick_cycles) const {
  // in 65ths of a cycle, so that a frame is a whole number
  constexpr Cycle kUnit = drivers::kScanPeriod;
  // so many that a frame more or less at either end is nothing, and whole threes of them
  constexpr int kSettle = 20 * drivers::kScanPeriod, kRounds = 300;
  static_assert(kRounds * drivers::kScanPeriod % 3 == 0);
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
  // to the nearest: what is cut off would be several frames a minute
  return (sequence_end - began + kRounds * kUnit / 2) / (kRounds * kUnit);
}

}  // namespace api
