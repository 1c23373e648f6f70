// SPDX-License-Identifier: MIT
// When the scan's handler is called and how long it takes, written out slot by slot [measured: trace of the
// register way]; and how long before its call each channel was held, by hand.
#pragma once
#include <vector>

#include "hal_sim/board/epuck_params.h"

namespace scan_times {

using board::Cycle;

struct Call {
  Cycle at, cycles;
};

/// Cycles from the call before to that of a slot: the converter stands before slots 3, 4, 33, 62, 63 and 64;
/// frames 5 to 32 are 22.5 cycles shorter.
inline Cycle frame_of(int slot) {
  switch (slot) {
    case 3:
      return 1015;
    case 4:
      return 984;
    case 33:
      return 1011;
    case 62:
      return 1003;
    case 63:
      return 1012;
    case 64:
      return 1005;
    default:
      return slot >= 5 && slot <= 32 ? (slot % 2 == 1 ? 877 : 878) : 900;
  }
}

inline Cycle cycles_of(int slot) {
  switch (slot) {
    case 2:
      return 170;
    case 3:
      return 206;
    case 32:
      return 165;
    case 61:
      return 154;
    case 62:
      return 186;
    case 63:
      return 201;
    case 64:
      return 117;
    default:
      return 109;
  }
}

/// The first `count` calls of a scan that is started at `start`; every hundredth takes 3 cycles more.
inline std::vector<Call> calls(Cycle start, int count) {
  std::vector<Call> all;
  Cycle at = start + 15;
  for (int i = 0; i < count; ++i) {
    at += frame_of(i % 65);
    all.push_back({at, cycles_of(i % 65) + (i % 100 == 99 ? 3 : 0)});
  }
  return all;
}

// From a channel's hold to the call: channels of 15 TAD, held after the first, and a cycle until the flag.
inline constexpr Cycle kFourth = (2 * 15 - 1) * 12 + 1, kFifth = (15 - 1) * 12 + 1;  // of five
inline constexpr Cycle kFiled = 117;  // from the call to the samples in their array
inline constexpr Cycle kLight = 152;  // from the call to an IR LED switched

}  // namespace scan_times
