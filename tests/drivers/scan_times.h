// SPDX-License-Identifier: MIT
// When the scan's handler is called, and how long before its call each channel was held, by hand.
#pragma once
#include <vector>

#include "hal_sim/board/epuck_params.h"

namespace scan_times {

using board::Cycle;

constexpr Cycle kSequence = 900;          // the conversions
constexpr Cycle kFrame = kSequence + 65;  // and the stop before them, but for the first
/// The calls after the converter was switched on at `start`: 15 cycles, a sequence, then frames.
inline std::vector<Cycle> calls(Cycle start, int count) {
  std::vector<Cycle> all;
  for (int i = 1; i <= count; ++i) all.push_back(start + 15 + kSequence + (i - 1) * kFrame);
  return all;
}

constexpr Cycle kFiled = 113;  // from a call to its samples in the array
constexpr Cycle kLight = 125;  // to the IR LED's switching
// 5 channels of 15 TAD of 12: the fourth is held after 46, the fifth after 61; the flag a cycle after the end
constexpr Cycle kFourth = (75 - 46) * 12 + 1;
constexpr Cycle kFifth = (75 - 61) * 12 + 1;
static_assert(kFourth == 349 && kFifth == 169);

}  // namespace scan_times
