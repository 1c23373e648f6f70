// SPDX-License-Identifier: MIT
// Both wheels under the library's motor driver, each an AgendaMotor that moves one of the board's steppers at
// the ticks that its agenda has processed. A motor is brought to an instant when somebody asks for it.
// Nothing that follows is earlier, whoever asks.
#pragma once
#include <cstdint>

#include "hal_sim/board/pin_driver.h"
#include "hal_sim/drivers/agenda_list.h"
#include "hal_sim/drivers/agenda_motor.h"
#include "hal_sim/drivers/agenda_ticks.h"

namespace drivers {

using board::Stepper;
using board::Wheel;

class AgendaMotors {
 public:
  /// The board's motors, left and right; all outlive this.
  AgendaMotors(const AgendaTicks& ticks, Stepper& left, Stepper& right);

  /// steps/s
  int speed(Wheel wheel) const { return of(wheel).speed(); }
  /// Does the driver step this wheel on and on?
  bool runs(Wheel wheel) const {
    return ticks_.is_running() && of(wheel).count.counts() && of(wheel).speed() != 0;
  }
  /// Would one firing at `at` switch the coils off, rather than step?
  bool switches_off(Wheel wheel, Cycle at) const { return of(wheel, at).phase_on && of(wheel).saves_power(); }
  /// The driver's step counter, not wrapped.
  std::int64_t commanded_steps(Wheel wheel, Cycle at) const { return of(wheel, at).commanded; }
  /// Cycle before which the step counter keeps its value without a command.
  Cycle steps_horizon(Wheel wheel, Cycle at) const { return next_step(of(wheel, at)); }
  /// How the wheel turns on: once it does so evenly (AgendaMotor::is_even()), for ever; before, and when it
  /// rests between steps, up to the next step; no further than `at` while the handler is held.
  board::RotorCourse course(Wheel wheel, Cycle at) const;
  /// Is another number once a wheel may turn otherwise than its course said: somebody has commanded motors,
  /// their agendas or the timer; ticks were lost; the handler is held, or no longer.
  std::uint64_t commands() const { return 2 * commands_ + (ticks_.is_held() ? 1 : 0); }
  /// Cycle before which the coils keep their state without a command.
  Cycle coils_horizon(Wheel wheel, Cycle at) const;
  /// The motor as it is at `at`, which is not before the last instant that anybody asked for.
  const Stepper& stepper_at(Wheel wheel, Cycle at) const {
    of(wheel, at);
    return *steppers_[static_cast<int>(wheel)];
  }

  // --- for the timer
  void note_command() { ++commands_; }
  const AgendaMotor& of(Wheel wheel) const { return motors_[static_cast<int>(wheel)]; }
  AgendaMotor& of(Wheel wheel) { return motors_[static_cast<int>(wheel)]; }
  Stepper& stepper(Wheel wheel) { return *steppers_[static_cast<int>(wheel)]; }
  /// The motor, brought to a tick; or to what its agenda has processed by `at`.
  AgendaMotor& bring_to(Wheel wheel, std::int64_t tick) { return brought(wheel, tick); }
  AgendaMotor& bring(Wheel wheel, Cycle at) { return brought(wheel, ticks_.done(serial(wheel), at)); }
  void bring_both_to(std::int64_t tick) {
    for (Wheel wheel : {Wheel::Left, Wheel::Right}) brought(wheel, tick);
  }
  void bring_both(Cycle at) {
    for (Wheel wheel : {Wheel::Left, Wheel::Right}) bring(wheel, at);
  }
  /// The rhythm of both is another one from now on.
  void disturb() {
    for (AgendaMotor& m : motors_) m.disturb();
  }
  /// Its agenda was activated; destroyed.
  void add_node(Wheel wheel, std::uint32_t serial) {
    serials_[static_cast<int>(wheel)] = serial;
    has_node_[static_cast<int>(wheel)] = true;
  }
  void drop_node(Wheel wheel) { has_node_[static_cast<int>(wheel)] = false; }
  bool has_node(Wheel wheel) const { return has_node_[static_cast<int>(wheel)]; }
  /// The driver's variables alone return to their start values.
  void forget(Wheel wheel);

  // --- nodes of the list, whose count is here if they are a motor's
  AgendaCount& count_of(AgendaList::Node& node) {
    return node.kind == AgendaList::Kind::User ? node.count : of(AgendaList::wheel_of(node.kind)).count;
  }
  const AgendaCount& count_of(const AgendaList::Node& node) const {
    return node.kind == AgendaList::Kind::User ? node.count : of(AgendaList::wheel_of(node.kind)).count;
  }
  /// Does this node need the handler when it fires?
  bool needs_handler(const AgendaList::Node& node) const {
    return node.kind == AgendaList::Kind::User || speed(AgendaList::wheel_of(node.kind)) == 0;
  }

 private:
  std::uint32_t serial(Wheel wheel) const { return serials_[static_cast<int>(wheel)]; }
  AgendaMotor& brought(Wheel wheel, std::int64_t tick) const {
    AgendaMotor& m = motors_[static_cast<std::size_t>(wheel)];
    m.advance_to(tick, ticks_.line(), *steppers_[static_cast<std::size_t>(wheel)]);
    return m;
  }
  const AgendaMotor& of(Wheel wheel, Cycle at) const {
    return brought(wheel, ticks_.done(serial(wheel), at));
  }
  Cycle next_step(const AgendaMotor& motor) const;

  const AgendaTicks& ticks_;
  std::uint64_t commands_ = 0;
  bool has_node_[2] = {false, false};
  std::uint32_t serials_[2] = {0, 0};
  Stepper* steppers_[2];
  mutable AgendaMotor motors_[2];  // as far as somebody has asked: when changes no answer
};

}  // namespace drivers
