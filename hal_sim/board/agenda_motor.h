// SPDX-License-Identifier: MIT
// One wheel under the library's usual motor driver: what run_left_motor() / run_right_motor() do at each
// firing of their agenda, and the closed form of many firings in a row.
//
//   |v| >= 601: step, step, step ...           every `cycle` ticks, coils stay on
//   |v| <= 600: step, coils off, step, off ... 15 ticks on, 10000/|v| - 15 ticks off (power save)
//
// Each firing re-arms the agenda itself in power save, so a speed set more often than it fires stretches both
// halves to a full period: the wheel then turns at about half speed, as on the robot.
// Source: [lib: motor_led/advance_one_timer/e_motors.c], facts restated.
#pragma once
#include <cstdint>
#include <cstdlib>

#include "hal_sim/board/epuck_params.h"
#include "hal_sim/board/stepper.h"

namespace board {

/// When the n-th processed tick of Timer 2 happens: a straight line, except one tick that came late because
/// its interrupt had to wait for a callback.
struct TickLine {
  Cycle origin = 0;  ///< tick n is due at origin + n * kAgendaTickCycles
  std::int64_t late_tick = -1;
  Cycle late_cycle = 0;

  Cycle cycle_of(std::int64_t tick) const {
    return tick == late_tick ? late_cycle : origin + tick * kAgendaTickCycles;
  }
};

/// One node of the agenda list: the counter after `tick` ticks have been processed.
struct AgendaCount {
  std::uint16_t cycle = 0;
  std::uint16_t counter = 0;
  bool active = true;
  std::int64_t tick = 0;

  bool counts() const { return active && cycle > 0; }
  /// Ticks from `tick` to the next firing, at least 1; meaningful when counts().
  std::int64_t ticks_to_fire() const {
    return counter + 1 >= cycle ? 1 : static_cast<std::int64_t>(cycle) - counter;
  }
};

/// The driver's statics for one wheel. Copying it is how const queries look ahead.
class AgendaMotor {
 public:
  explicit AgendaMotor(int forward) : stepper(forward) {}

  AgendaCount count;           ///< its node; count.active stays false while no node exists
  Stepper stepper;             ///< the motor itself
  int phase = 0;               ///< the driver's idea of the rotor
  bool phase_on = false;       ///< power save: the next firing switches the coils off
  std::int64_t commanded = 0;  ///< steps counted by the driver, not wrapped

  /// steps/s, clamped
  int speed() const { return speed_; }
  void set_speed(int speed) {
    speed_ = speed;
    magnitude_ = std::abs(speed);
    save_period_ = speed == 0 ? 0 : kSpeedUnit / magnitude_;
  }

  bool saves_power() const { return magnitude_ < kPowerSaveBelow; }

  /// What the agenda's function does once. `pins_at`: from the cycles between its call and its last change of
  /// a pin to the cycle of that. False: it divided by zero.
  template <typename PinsAt>
  bool fire(const PinsAt& pins_at) {
    if (phase_on && saves_power()) {
      stepper.set_coils_only(0);
      phase_on = false;
      if (speed_ == 0) return false;
      set_cycle(save_period_ - kPowerSaveTicks);
      return true;
    }
    const int direction = step_direction();
    commanded += direction;
    phase = (phase + direction * stepper.forward()) & 3;
    stepper.energise(kPhaseCoils[phase], pins_at(pin_cycles(stepper.coils(), kPhaseCoils[phase])));
    if (saves_power()) {
      phase_on = true;
      set_cycle(kPowerSaveTicks);
    }
    return true;
  }

  /// Processes all ticks up to `tick`. `pins_at(n, cycles)`: when a firing of tick n changes its last pin,
  /// `cycles` after its call. Speed 0 is stepped by the caller, firing by firing.
  template <typename PinsAt>
  void advance_to(std::int64_t tick, const TickLine& line, const PinsAt& pins_at) {
    if (tick <= count.tick) return;
    if (!count.counts() || speed_ == 0) {
      count_idle(tick);
      return;
    }
    const auto fire_at = [&](std::int64_t fire_tick) {
      count.tick = fire_tick;
      fire([&](Cycle cycles) { return pins_at(fire_tick, cycles); });
      count.counter = 0;
    };
    // firing by firing until driver, rotor and rhythm agree
    while (regular_ < kRegularFirings) {
      const std::int64_t fire_tick = count.tick + count.ticks_to_fire();
      if (fire_tick > tick) {
        count_idle(tick);
        return;
      }
      fire_at(fire_tick);
      regular_ = stepper.is_at(phase) && fire_tick > line.late_tick ? regular_ + 1 : 0;
    }
    // then all steps up to the last one at once: one every period
    const std::int64_t period = full_period(), last_firing = count.tick - count.counter;
    const std::int64_t before_first = phase_on_is_new() ? last_firing : last_firing - kPowerSaveTicks;
    const std::int64_t steps = quotient(tick - before_first, period);
    if (steps > 0) {
      const int direction = step_direction(), turned = direction * stepper.forward();
      const std::int64_t last_step = before_first + steps * period;
      commanded += steps * direction;
      phase = static_cast<int>((phase + steps * turned) & 3);
      const auto step_pins = [&](int back) {
        const unsigned coils = kPhaseCoils[(phase - back * turned) & 3];
        const unsigned old = saves_power() ? 0 : kPhaseCoils[(phase - (back + 1) * turned) & 3];
        return pins_at(last_step - back * period, pin_cycles(old, coils));
      };
      const Cycle last = step_pins(0), before = steps > 1 ? step_pins(1) : 0;
      stepper.turn(steps, direction, last, before, steps > 2 ? step_pins(2) : 0, kPhaseCoils[phase]);
      count.tick = last_step;
      count.counter = 0;
      if (saves_power()) {
        phase_on = true;
        set_cycle(kPowerSaveTicks);
      }
    }
    if (count.tick + count.ticks_to_fire() <= tick) fire_at(count.tick + count.ticks_to_fire());
    count_idle(tick);
  }

  /// Firings at ticks after the one processed last, up to `tick`; without a command.
  std::int64_t firings_until(std::int64_t tick) const {
    if (!count.counts() || speed_ == 0) return 0;
    const std::int64_t first = count.tick + count.ticks_to_fire();
    if (tick < first) return 0;
    const std::int64_t after = tick - first, period = full_period(), whole = quotient(after, period);
    if (!saves_power()) return whole + 1;
    return whole * 2 + (after - whole * period >= second_half() ? 2 : 1);
  }
  /// What the processor spends on a firing: a step, to a phase at which it is least, or the coils' switching
  /// off.
  Cycle step_cycles() const {
    return (saves_power() ? kMotorHalfStepCycles : kMotorStepCycles + (phase_on ? kMotorOldHalfCycles : 0)) -
           (is_left() ? kMotorLeftStepLess : 0) + turn_cycles();
  }
  Cycle off_cycles() const { return kMotorOffCycles + (is_left() ? kMotorLeftOffMore : 0) + turn_cycles(); }
  /// More of a step to phase 1 or 2.
  Cycle long_step_more() const { return is_left() ? kMotorLongStepMore : 0; }
  /// Of a step and what belongs to it, on average; ticks from one to the next.
  Cycle period_cycles() const {
    return step_cycles() + long_step_more() / 2 + (saves_power() ? off_cycles() : 0);
  }
  std::int64_t full_period() const { return saves_power() ? save_period_ : count.cycle; }
  /// The same of the firing at this tick, which comes later than the one processed last; 0 for none.
  Cycle firing_cycles(std::int64_t tick) const {
    const std::int64_t after = tick - count.tick - count.ticks_to_fire();
    if (after < 0 || !count.counts() || speed_ == 0) return 0;
    const std::int64_t period = full_period(), whole = quotient(after, period), into = after - whole * period;
    if (into == 0) return cycles_of(saves_power() ? 2 * whole : whole, 1);
    return saves_power() && into == second_half() ? cycles_of(2 * whole + 1, 1) : 0;
  }
  /// What `number` firings take, the `first` after the one processed last.
  Cycle cycles_of(std::int64_t first, std::int64_t number) const {
    const std::int64_t before = steps_in(first), steps = steps_in(first + number) - before;
    Cycle cycles = steps * step_cycles() + (number - steps) * off_cycles();
    if (is_left()) cycles += (long_steps(before + steps) - long_steps(before)) * kMotorLongStepMore;
    return cycles;
  }

  /// Tick of the next step (not coil-off), or -1 if there is none without a command.
  std::int64_t next_step_tick() const {
    if (!count.counts() || speed_ == 0) return -1;
    std::int64_t next = count.tick + count.ticks_to_fire();
    if (phase_on && saves_power()) next += save_period_ - kPowerSaveTicks;
    return next;
  }

  void set_cycle(int cycle) { count.cycle = static_cast<std::uint16_t>(cycle); }

  /// Somebody changed speed, cycle, pins or phase: the rhythm has to be found again.
  void disturb() { regular_ = 0; }

 private:
  /// Firings in a row after which every step has had the time to finish, so that periods can be added up: two
  /// steps that came a period after the one before.
  static constexpr int kRegularFirings = 6;
  int regular_ = 0;
  int speed_ = 0, magnitude_ = 0;
  int save_period_ = 0;  // ticks from step to step in power save

  bool is_left() const { return stepper.forward() < 0; }
  /// More of a firing whose steps lower the phase.
  Cycle turn_cycles() const { return step_direction() * stepper.forward() < 0 ? kMotorTurnMore : 0; }
  /// Steps among the next `firings`.
  std::int64_t steps_in(std::int64_t firings) const {
    return !saves_power() ? firings : phase_on ? firings / 2 : (firings + 1) / 2;
  }
  /// Of the next `steps`, those to phase 1 or 2.
  std::int64_t long_steps(std::int64_t steps) const {
    const int turn = step_direction() * stepper.forward();
    std::int64_t sum = steps / 4 * 2;
    for (std::int64_t i = steps / 4 * 4 + 1; i <= steps; ++i)
      sum += is_long(phase + static_cast<int>(i & 3) * turn);
    return sum;
  }
  static bool is_long(int phase) { return ((phase + 1) & 2) != 0; }
  /// left: forward only for v > 0; right: backward only for v < 0
  int step_direction() const {
    if (stepper.forward() < 0) return speed_ > 0 ? 1 : -1;
    return speed_ < 0 ? -1 : 1;
  }
  /// Of numbers that are small nearly always: a short division takes half the time.
  static std::int64_t quotient(std::int64_t ticks, std::int64_t period) {
    if (static_cast<std::uint64_t>(ticks) >> 32) return ticks / period;
    return static_cast<std::uint32_t>(ticks) / static_cast<std::uint32_t>(period);
  }
  /// Power save: ticks from the next firing, which sets the cycle for it, to the one after.
  std::int64_t second_half() const { return phase_on ? full_period() - kPowerSaveTicks : kPowerSaveTicks; }
  /// In a regular rhythm: was the last firing a step (true) or the coils' switching off?
  bool phase_on_is_new() const { return !saves_power() || phase_on; }
  /// From the function's call to its last change of a pin.
  Cycle pin_cycles(unsigned from, unsigned to) const {
    int last = 3;
    while (last > 0 && ((from ^ to) >> last & 1) == 0) --last;
    return kMotorPinCycles[last] + ((from >> last & 1) != 0 ? kMotorPinClearedCycles : 0) +
           (phase_on && !saves_power() ? kMotorOldHalfCycles : 0) -
           (stepper.forward() < 0 ? kMotorPinsLeftSooner : 0);
  }

  void count_idle(std::int64_t tick) {
    if (count.counts()) count.counter = static_cast<std::uint16_t>(count.counter + (tick - count.tick));
    count.tick = tick;
  }
};

}  // namespace board
