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
  int speed = 0;               ///< steps/s, clamped
  int phase = 0;               ///< the driver's idea of the rotor
  bool phase_on = false;       ///< power save: the next firing switches the coils off
  std::int64_t commanded = 0;  ///< steps counted by the driver, not wrapped

  /// Does the next firing divide by zero? (speed 0 with a cycle set by hand, in the off half)
  bool next_fire_traps() const { return speed == 0 && phase_on; }

  /// What the agenda's function does once, at cycle `at`. False: it divided by zero.
  bool fire(Cycle at) {
    const int magnitude = std::abs(speed);
    if (phase_on && magnitude < kPowerSaveBelow) {
      stepper.set_coils_only(0);
      phase_on = false;
      if (magnitude == 0) return false;
      set_cycle(kSpeedUnit / magnitude - kPowerSaveTicks);
      return true;
    }
    const int direction = step_direction();
    commanded += direction;
    phase = (phase + direction * stepper.forward()) & 3;
    stepper.energise(kPhaseCoils[phase], at);
    if (magnitude < kPowerSaveBelow) {
      phase_on = true;
      set_cycle(kPowerSaveTicks);
    }
    return true;
  }

  /// Processes all ticks up to `tick`. Speed 0 is stepped by the caller, firing by firing.
  void advance_to(std::int64_t tick, const TickLine& line) {
    if (tick <= count.tick) return;
    if (!count.counts() || speed == 0) {
      count_idle(tick);
      return;
    }
    // firing by firing until driver, rotor and rhythm agree; then only up to the next one
    do {
      const std::int64_t fire_tick = count.tick + count.ticks_to_fire();
      if (fire_tick > tick) {
        count_idle(tick);
        return;
      }
      count.tick = fire_tick;
      fire(line.cycle_of(fire_tick));
      count.counter = 0;
      regular_ = stepper.is_at(phase) && fire_tick > line.late_tick ? regular_ + 1 : 0;
    } while (regular_ < kRegularFirings);
    regular_ = kRegularFirings;
    // whole periods at once; each ends in the state it began with
    const std::int64_t period = full_period();
    const std::int64_t periods = (tick - count.tick) / period;
    if (periods > 0) {
      const int direction = step_direction();
      const std::int64_t end = count.tick + periods * period;
      const std::int64_t last_step = phase_on_is_new() ? end : end - kPowerSaveTicks;
      commanded += periods * direction;
      phase = static_cast<int>((phase + periods * direction * stepper.forward()) & 3);
      stepper.turn(periods, direction, line.cycle_of(last_step), move_cycles(),
                   phase_on_is_new() ? kPhaseCoils[phase] : 0u);
      count.tick = end;
    }
    while (count.tick + count.ticks_to_fire() <= tick) {
      count.tick += count.ticks_to_fire();
      fire(line.cycle_of(count.tick));
      count.counter = 0;
    }
    count_idle(tick);
  }

  /// Tick of the next step (not coil-off), or -1 if there is none without a command.
  std::int64_t next_step_tick() const {
    if (!count.counts() || speed == 0) return -1;
    std::int64_t next = count.tick + count.ticks_to_fire();
    if (phase_on && std::abs(speed) < kPowerSaveBelow) next += kSpeedUnit / std::abs(speed) - kPowerSaveTicks;
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

  /// left: forward only for v > 0; right: backward only for v < 0
  int step_direction() const {
    if (stepper.forward() < 0) return speed > 0 ? 1 : -1;
    return speed < 0 ? -1 : 1;
  }
  /// Time the rotor has for a step.
  Cycle move_cycles() const {
    const int magnitude = std::abs(speed);
    const Cycle ticks = magnitude >= kPowerSaveBelow ? count.cycle
                        : magnitude > 0              ? kSpeedUnit / magnitude
                                                     : 0;
    const Cycle cycles = ticks * kAgendaTickCycles;
    return cycles > 0 && cycles < kRotorMoveCycles ? cycles : kRotorMoveCycles;
  }
  std::int64_t full_period() const {
    const int magnitude = std::abs(speed);
    return magnitude < kPowerSaveBelow ? kSpeedUnit / magnitude : count.cycle;
  }
  /// In a regular rhythm: was the last firing a step (true) or the coils' switching off?
  bool phase_on_is_new() const { return std::abs(speed) >= kPowerSaveBelow || phase_on; }

  void count_idle(std::int64_t tick) {
    if (count.counts()) count.counter = static_cast<std::uint16_t>(count.counter + (tick - count.tick));
    count.tick = tick;
  }
};

}  // namespace board
