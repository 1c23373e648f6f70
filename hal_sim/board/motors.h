// SPDX-License-Identifier: MIT
// The two stepper motors and their wheels. A motor is moved by the coil pins of port D, or by a driver in
// closed form that is brought up to the instant at which somebody looks. Each motor alone: stepper.h.
#pragma once
#include <array>
#include <cstdint>

#include "hal_sim/board/pin_driver.h"
#include "hal_sim/board/stepper.h"
#include "hal_sim/board/wiring.h"

namespace board {

/// How a wheel turns: its angle, the rate per cycle, and until when; `until` not after the instant asked for:
/// known at that instant only.
struct WheelTurn {
  double angle_rad = 0, rate_rad = 0;
  Cycle until = 0;
};

class Motors {
 public:
  /// `wheel_ratio`: true over nominal wheel size, left and right; it outlives this.
  explicit Motors(const std::array<double, 2>& wheel_ratio) : wheel_ratio_(wheel_ratio) {}

  // --- the wheels
  /// Angle the wheel has turned since power-up, rad, forward positive, wheel ratio included. The rotor needs
  /// up to kRotorMoveCycles to follow a step, so constant speed gives a constant rim speed. O(1). `at` not
  /// before the last command.
  double angle_rad(Wheel wheel, Cycle at) const;
  /// The same, how fast it grows, and until when at that rate, unless somebody commands the motor.
  WheelTurn turn(Wheel wheel, Cycle at) const;
  /// Is another number once somebody has commanded a motor.
  std::uint64_t commands() const { return commands_ + (driver_ ? driver_->motor_commands() : 0); }
  /// Full steps since power-up, forward positive, not wrapped, lost steps not counted.
  std::int64_t steps(Wheel wheel, Cycle at) const { return at_instant(wheel, at).steps(); }
  std::int64_t left_steps(Cycle at) const { return steps(Wheel::Left, at); }
  std::int64_t right_steps(Cycle at) const { return steps(Wheel::Right, at); }

  // --- the motors
  /// Coils A to D in bits 0 to 3.
  unsigned coils(Wheel wheel, Cycle at) const { return at_instant(wheel, at).coils(); }
  /// Coils of both as they lie on port D.
  std::uint16_t coil_pins(Cycle at) const;
  /// Share of the time for which both coils are energised while nothing new is commanded, 0 to 1.
  double duty(Wheel wheel, Cycle at) const;
  /// Steps that were lost and coils that heat, up to `at`.
  StepperFaults faults(Wheel wheel, Cycle at) const { return at_instant(wheel, at).faults(at); }
  /// The motor, brought to `at`, for changing it.
  Stepper& stepper(Wheel wheel, Cycle at);
  /// The motor as it was left, for a PinDriver.
  Stepper& own(Wheel wheel) { return own_[static_cast<std::size_t>(wheel)]; }
  /// Moves them from now on; null: nobody but the pins.
  void attach(PinDriver* driver) {
    commands_ = commands() + 1;
    driver_ = driver;
    commands_ -= commands() - commands_;
  }

  // --- what happens to them
  /// The latch of port D: a motor whose pattern changed follows. True: the number of energised coils changed.
  bool write(std::uint16_t latch, Cycle at);
  /// Directions of port D: a motor is connected when all four pins are outputs.
  void set_directions(std::uint16_t tris, Cycle at);
  /// Steps of a wheel are lost from `at` on as this says (null: no longer); it outlives the motor's use.
  void lose_steps(Wheel wheel, StepLoss* loss, Cycle at) { stepper(wheel, at).lose_steps(loss); }
  /// All coils are without current.
  void release(Cycle at);
  /// The pins float, and the wheels stay where they are.
  void processor_reset();
  /// As when the robot was first switched on, and no step is lost any more.
  void begin_again(Cycle at);

 private:
  const Stepper& at_instant(Wheel wheel, Cycle at) const {
    return driver_ ? driver_->motor_at(wheel, at) : own_[static_cast<std::size_t>(wheel)];
  }

  PinDriver* driver_ = nullptr;
  std::uint64_t commands_ = 0;  // those of the driver are not in it
  const std::array<double, 2>& wheel_ratio_;
  Stepper own_[2] = {Stepper(-1), Stepper(+1)};
};

}  // namespace board
