// SPDX-License-Identifier: MIT
// What the robot draws from its battery: a sum over the devices that are on (battery_params.h).
//
// Modelled: processor, Bluetooth, board, camera out of reset, codec on, coils, LEDs, IR emitters.
// Not modelled: the loudspeaker's own current, turrets, the processor's sleep (a program that waits in a loop
// draws the full current, as on the robot; one that uses pwrsav draws it here too).
#include <algorithm>
#include <cstdlib>

#include "hal_sim/board/board.h"

namespace board {

namespace {

constexpr std::uint32_t kRing = 0xFF, kBody = 0x100, kFront = 0x200;  // of leds()

int ones(unsigned word) {
  int n = 0;
  for (; word; word &= word - 1) ++n;
  return n;
}

}  // namespace

double Board::coil_duty(Wheel wheel, Cycle at) const {
  if (!motors_[static_cast<std::size_t>(wheel)].connected()) return 0;
  const auto driven = driver_ ? driver_->coil_duty(wheel) : std::nullopt;
  return driven ? *driven : ones(coils(wheel, at)) / 2.0;
}

double Board::coils_a(Wheel wheel, Cycle at) const { return 2 * kCoilA * coil_duty(wheel, at); }

double Board::other_a(Cycle at) const {
  double amps = kProcessorA + kBluetoothA + kBoardA;
  const std::uint32_t lit = leds(at);
  if (lit & kRing) amps += kRingLedA * ones(lit & kRing);
  if (lit & kBody) amps += kBodyLedA;
  if (lit & kFront) amps += kFrontLedA;
  if (output_high(kCameraResetPin)) amps += kCameraA;
  if (output_high(kCodecOnPin)) amps += kCodecA;
  return amps;
}

// the drivers' flashes by their mean, lines that a program holds by their latch
double Board::emitters_a(Cycle at) const {
  double lines = 0;
  for (int sensor = 0; sensor < 4; ++sensor) lines += line_on_for(sensor, at) >= 0 ? 1 : 0;
  if (driver_) lines += driver_->mean_pulses();
  return 2 * kIrEmitterA * lines;
}

}  // namespace board
