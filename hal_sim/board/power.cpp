// SPDX-License-Identifier: MIT
#include "hal_sim/board/power.h"

namespace board {

Power::Power(const Setup& setup) : battery_(setup.battery_wh, setup.battery_v, kAlwaysA) {}

void Power::set_others(std::uint32_t leds, bool camera, bool codec) {
  constexpr std::uint32_t kRing = 0xFF, kBody = 0x100, kFront = 0x200;
  others_a_ = kAlwaysA;
  if (leds & kRing) others_a_ += kRingLedA * __builtin_popcount(leds & kRing);
  if (leds & kBody) others_a_ += kBodyLedA;
  if (leds & kFront) others_a_ += kFrontLedA;
  if (camera) others_a_ += kCameraA;
  if (codec) others_a_ += kCodecA;
}

void Power::begin_again(double volts, Cycle at) {
  battery_.weaken(0, 0, at);
  battery_.begin_again(volts, kAlwaysA, at);
}

}  // namespace board
