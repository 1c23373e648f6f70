// SPDX-License-Identifier: MIT
#include "hal_sim/drivers/agenda_motors.h"

#include <algorithm>

namespace drivers {

using namespace board;

AgendaMotors::AgendaMotors(const AgendaTicks& ticks, Stepper& left, Stepper& right)
    : ticks_(ticks), steppers_{&left, &right}, motors_{AgendaMotor(-1), AgendaMotor(+1)} {
  for (AgendaMotor& m : motors_) m.count.active = false;
}

board::RotorCourse AgendaMotors::course(Wheel wheel, Cycle at) const {
  const AgendaMotor& m = of(wheel, at);
  const Stepper& rotor = *steppers_[static_cast<std::size_t>(wheel)];
  const Cycle step = next_step(m), period = m.full_period() * kAgendaTickCycles;
  if (step < kNever && !ticks_.is_walking() && m.is_even() && period <= kRotorMoveCycles &&
      rotor.is_at(m.phase)) {
    const double rate = m.step_direction() / static_cast<double>(period);
    return {static_cast<double>(rotor.steps()) - rate * static_cast<double>(step - at), rate, kNever};
  }
  board::RotorCourse course = rotor.course(at);
  course.until = ticks_.is_held() ? at : std::min(course.until, step);
  return course;
}

Cycle AgendaMotors::next_step(const AgendaMotor& motor) const {
  if (ticks_.stands()) return kNever;
  const std::int64_t tick = motor.next_step_tick();
  return tick < 0 ? kNever : ticks_.line().cycle_of(tick);
}

Cycle AgendaMotors::coils_horizon(Wheel wheel, Cycle at) const {
  if (ticks_.stands()) return kNever;
  const AgendaMotor& m = of(wheel, at);
  if (!m.count.counts() || m.speed() == 0) return kNever;
  return ticks_.line().cycle_of(m.count.tick + m.count.ticks_to_fire());
}

void AgendaMotors::forget(Wheel wheel) {
  of(wheel) = AgendaMotor(stepper(wheel).forward());
  of(wheel).count.active = false;
  add_node(wheel, 0);
  drop_node(wheel);
}

}  // namespace drivers
