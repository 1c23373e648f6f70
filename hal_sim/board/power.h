// SPDX-License-Identifier: MIT
// The robot's power: its battery, and the sum of what everything that is on draws (battery_params.h).
// Whoever switches a device says so (pins.h does); nobody is asked.
//
// Modelled: processor, Bluetooth, board, camera out of reset, codec on, coils, LEDs, IR emitters.
// Not modelled: the loudspeaker's own current, turrets, the processor's sleep (a program that waits in a loop
// draws the full current, as on the robot; one that uses pwrsav draws it here too).
#pragma once
#include <cstdint>

#include "hal_sim/board/battery.h"
#include "hal_sim/board/setup.h"
#include "hal_sim/board/stepper.h"

namespace board {

class Power {
 public:
  explicit Power(const Setup& setup);

  const Battery& battery() const { return battery_; }
  /// Another battery state, as if charged: terminal voltage at `at`, V.
  void set_voltage(double volts, Cycle at) { battery_.set_voltage(volts, at); }
  /// Battery::weaken().
  void weaken(double drop_v, double more_ohm, Cycle at) { battery_.weaken(drop_v, more_ohm, at); }
  /// The robot is switched off for good: nothing is drawn.
  void switch_off() { battery_.draw(0, 0); }
  /// As at power-up with `volts`, from `at` on, and nothing is wrong with it any more.
  void begin_again(double volts, Cycle at);

  // --- what is on; counts from the next draw() on
  /// Share of the time for which a motor's two coils are energised, 0 to 1.
  void set_coils(Wheel wheel, double duty) { coils_a_[static_cast<std::size_t>(wheel)] = 2 * kCoilA * duty; }
  /// IR emitter lines that are high, of which each has two emitters; on average 0 to 4.
  void set_emitters(double lines) { emitters_a_ = 2 * kIrEmitterA * lines; }
  /// LEDs (bits as Pins::leds()), camera out of reset, codec on.
  void set_others(std::uint32_t leds, bool camera, bool codec);
  /// All that flows from `at` on.
  void draw(Cycle at) { battery_.draw(others_a_ + coils_a_[0] + coils_a_[1] + emitters_a_, at); }

 private:
  static constexpr double kAlwaysA = kProcessorA + kBluetoothA + kBoardA;

  double others_a_ = kAlwaysA, coils_a_[2] = {0, 0}, emitters_a_ = 0;
  Battery battery_;
};

}  // namespace board
