// SPDX-License-Identifier: MIT
#include "hal_sim/board/motors.h"

#include "sim_core/base/portable_math.h"

namespace board {

static constexpr Wheel kBoth[] = {Wheel::Left, Wheel::Right};

double Motors::angle_rad(Wheel wheel, Cycle at) const {
  const double steps = at_instant(wheel, at).position(at);
  return steps * (sim::kTwoPi / kStepsPerTurn) * wheel_ratio_[static_cast<std::size_t>(wheel)];
}

WheelTurn Motors::turn(Wheel wheel, Cycle at) const {
  const double rad_per_step = sim::kTwoPi / kStepsPerTurn * wheel_ratio_[static_cast<std::size_t>(wheel)];
  const Stepper& own = own_[static_cast<std::size_t>(wheel)];
  const RotorCourse rotor = driver_ ? driver_->motor_course(wheel, at) : own.course(at);
  return {rotor.steps * rad_per_step, rotor.rate * rad_per_step, rotor.until};
}

std::uint16_t Motors::coil_pins(Cycle at) const {
  return static_cast<std::uint16_t>(coils(Wheel::Right, at) << kRightCoilsBit | coils(Wheel::Left, at));
}

double Motors::duty(Wheel wheel, Cycle at) const {
  if (!own_[static_cast<std::size_t>(wheel)].connected()) return 0;
  const auto driven = driver_ ? driver_->coil_duty(wheel) : std::nullopt;
  return driven ? *driven : __builtin_popcount(coils(wheel, at)) / 2.0;
}

Stepper& Motors::stepper(Wheel wheel, Cycle at) {
  if (driver_) driver_->bring_motor(wheel, at);
  ++commands_;
  return own(wheel);
}

bool Motors::write(std::uint16_t latch, Cycle at) {
  constexpr int kOnes[16] = {0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4};
  bool is_current_new = false;
  for (const Wheel wheel : kBoth) {
    const unsigned coils = (latch >> (wheel == Wheel::Left ? 0 : kRightCoilsBit)) & 15u;
    const unsigned before = this->coils(wheel, at);
    if (coils == before) continue;
    is_current_new |= kOnes[coils] != kOnes[before];
    stepper(wheel, at).energise(coils, at);
  }
  return is_current_new;
}

void Motors::set_directions(std::uint16_t tris, Cycle at) {
  stepper(Wheel::Left, at).connect((tris & kLeftCoils) == 0, at);
  stepper(Wheel::Right, at).connect((tris & kRightCoils) == 0, at);
}

void Motors::release(Cycle at) {
  for (const Wheel wheel : kBoth) stepper(wheel, at).set_coils_only(0);
}

void Motors::processor_reset() {
  ++commands_;
  for (Stepper& motor : own_) {
    motor.connect(false);
    motor.set_coils_only(0);
  }
}

void Motors::begin_again(Cycle at) {
  ++commands_;
  for (Stepper& motor : own_) {
    motor.begin_again(at);
    motor.lose_steps(nullptr);
  }
}

}  // namespace board
