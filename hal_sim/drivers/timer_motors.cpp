// SPDX-License-Identifier: MIT
// See timer_motors.h.
#include "hal_sim/drivers/timer_motors.h"

#include <algorithm>
#include <cstdlib>

namespace drivers {

using namespace board;

int StepTrain::direction(const Stepper& stepper) const {
  if (stepper.forward() < 0) return speed > 0 ? 1 : -1;
  return speed < 0 ? -1 : 1;
}

void StepTrain::advance_to(Cycle at, Stepper& stepper) {
  if (coils_off_at >= 0 && coils_off_at <= at) {
    stepper.set_coils_only(0);
    coils_off_at += ((at - coils_off_at) / kTimer3TickCycles + 1) * kTimer3TickCycles;
  }
  if (!running) return;
  const int toward = direction(stepper);
  // step by step until driver, rotor and rhythm agree, then all at once
  for (int regular = 0; next <= at && regular < 3;) {
    commanded += toward;
    phase = (phase + toward * stepper.forward()) & 3;
    stepper.energise(kPhaseCoils[phase], next);
    next += period;
    // too fast for the motor: it has to be asked each time
    regular = stepper.is_at(phase) && period >= kPullOutCycles ? regular + 1 : 0;
  }
  if (next > at) return;
  const std::int64_t count = (at - next) / period + 1;
  commanded += count * toward;
  phase = static_cast<int>((phase + count * toward * stepper.forward()) & 3);
  const Cycle last = next + (count - 1) * period;
  stepper.turn(count, toward, last, last - period, last - 2 * period, kPhaseCoils[phase]);
  next += count * period;
}

void TimerMotors::start_timer3(Cycle at) {
  timer3_runs_ = was_used_ = true;
  timer3_origin_ = at;
  for (StepTrain& train : trains_[static_cast<int>(Driver::Timer3)]) {
    train.running = false;
    train.speed = 0;
    train.coils_off_at = at + kTimer3TickCycles;
  }
}

void TimerMotors::set_speed(Driver driver, Wheel wheel, int speed, Cycle at, Stepper& stepper) {
  was_used_ = true;
  move(wheel, at, stepper);
  StepTrain& t = train(driver, wheel);
  if (driver == Driver::Basic) {
    if (speed == 0) {
      t.running = false;  // the driver keeps its speed variable
      stepper.set_coils_only(0);
      return;
    }
    // abs(-32768) stays negative in 16 bits and the timer gets the longest period
    const int period_register = speed == INT16_MIN ? UINT16_MAX : kBasicMotorUnit / std::abs(speed);
    t.speed = speed;
    t.running = true;
    t.period = (Cycle{period_register} + 1) * kBasicMotorPrescale;
    t.next = at + t.period;
    return;
  }
  t.speed = std::clamp(speed, -kTimer3MaxSpeed, kTimer3MaxSpeed);
  if (!timer3_runs_) return;
  const std::int64_t tick = (at - timer3_origin_) / kTimer3TickCycles;
  if (t.speed == 0) {
    t.running = false;
    t.coils_off_at = timer3_origin_ + (tick + 1) * kTimer3TickCycles;
    return;
  }
  const std::int64_t ticks = kSpeedUnit / std::abs(t.speed);
  t.running = true;
  t.coils_off_at = -1;
  t.period = ticks * kTimer3TickCycles;
  t.next = timer3_origin_ + (tick + ticks) * kTimer3TickCycles;
}

std::int64_t TimerMotors::commanded_steps(Driver driver, Wheel wheel, Cycle at,
                                          const Stepper& stepper) const {
  StepTrain t = train(driver, wheel);
  Stepper copy = stepper;
  t.advance_to(at, copy);
  return t.commanded;
}

Cycle TimerMotors::coils_horizon(Wheel wheel, Cycle at) const {
  const StepTrain& t = train(Driver::Timer3, wheel);
  const Cycle steps = steps_horizon(wheel, at);
  if (t.coils_off_at < 0) return steps;
  return std::min(steps, t.coils_off_at > at ? t.coils_off_at : at + 1);
}

Cycle TimerMotors::steps_horizon(Wheel wheel, Cycle at) const {
  Cycle earliest = kNever;
  if (!was_used_) return earliest;
  for (const auto& driver : trains_) {
    const StepTrain& t = driver[index(wheel)];
    if (!t.running) continue;
    const Cycle next = t.next > at ? t.next : t.next + ((at - t.next) / t.period + 1) * t.period;
    earliest = std::min(earliest, next);
  }
  return earliest;
}

void TimerMotors::move(Wheel wheel, Cycle at, Stepper& stepper) {
  for (auto& driver : trains_) driver[index(wheel)].advance_to(at, stepper);
}

void TimerMotors::peek(Wheel wheel, Cycle at, Stepper& copy) const {
  for (const auto& driver : trains_) {
    StepTrain t = driver[index(wheel)];
    t.advance_to(at, copy);
  }
}

Cycle TimerMotors::interrupt_period(Wheel wheel) const {
  const StepTrain& t = train(Driver::Basic, wheel);
  return t.running ? t.period : 0;
}

void TimerMotors::reset() {
  for (auto& driver : trains_)
    for (StepTrain& t : driver) t = StepTrain{};
  timer3_runs_ = was_used_ = false;
}

}  // namespace drivers
