// SPDX-License-Identifier: MIT
// Numbers of the infrared remote control; tags as in epuck_params.h, and [RC5]: the
// Philips code as published.
#pragma once
#include "sim_core/base/clock.h"

namespace board {

// a bit is 64 periods of the 36 kHz carrier, 1.778 ms, and half of it 65536 / 5 clicks exactly
inline constexpr std::int64_t kRc5HalfBitNumerator = 65536;  // clicks [RC5]
inline constexpr std::int64_t kRc5HalfBitDenominator = 5;    // [RC5]
static_assert(kRc5HalfBitNumerator * 36000 == 32 * sim::kClicksPerSecond * kRc5HalfBitDenominator);
inline constexpr int kRc5Bits = 14;          // two start bits, toggle, 5 of address, 6 of the key [RC5]
inline constexpr int kRc5FrameHalves = 128;  // from one frame to the next while a key is held: 113.8 ms [RC5]

}  // namespace board
