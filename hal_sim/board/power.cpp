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
  const Stepper& motor = agendas_.stepper_at(wheel, at);  // of a timer's train: connected, and driven, alike
  if (!motor.connected()) return 0;
  if (timer_motors_.drives(wheel)) return 1;  // these drivers leave the coils on from step to step
  if (!agendas_.runs(wheel)) return ones(motor.coils()) / 2.0;
  const int magnitude = std::abs(agendas_.speed(wheel));
  if (magnitude >= kPowerSaveBelow) return 1;
  const int period = magnitude > 0 ? kSpeedUnit / magnitude : 0;
  return period > 0 ? std::min(1.0, static_cast<double>(kPowerSaveTicks) / period) : 0;
}

double Board::beside_emitters_a(Cycle at) const {
  double amps = kProcessorA + kBluetoothA + kBoardA;
  for (Wheel wheel : {Wheel::Left, Wheel::Right}) amps += 2 * kCoilA * coil_duty(wheel, at);

  const std::uint32_t lit = leds(at);
  if (lit & kRing) amps += kRingLedA * ones(lit & kRing);
  if (lit & kBody) amps += kBodyLedA;
  if (lit & kFront) amps += kFrontLedA;
  if (output_high('C', kCameraResetBit)) amps += kCameraA;
  if (output_high('F', kCodecOnBit)) amps += kCodecA;
  return amps;
}

// the drivers' flashes by their mean, lines that a program holds by their latch
double Board::emitters_a(Cycle at) const {
  double lines = 0;
  for (int sensor = 0; sensor < 4; ++sensor) lines += line_on_for(sensor, at) >= 0 ? 1 : 0;
  if (scan_.is_on() && !scan_.micro_only()) lines += static_cast<double>(kScanLitInterrupts) / kScanPeriod;
  if (basic_prox_.is_on())
    lines +=
        static_cast<double>(kBasicPulseCycles) / static_cast<double>(kBasicPulseCycles + kBasicRestCycles);
  return 2 * kIrEmitterA * lines;
}

}  // namespace board
