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

#include "hal_sim/board/stepper.h"
#include "hal_sim/drivers/driver_params.h"

namespace drivers {

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

/// The driver's statics for one wheel; the motor that they move is handed in.
class AgendaMotor {
 public:
  /// `forward` as the Stepper's.
  explicit AgendaMotor(int forward) : forward_(forward) {}

  AgendaCount count;           ///< its node; count.active stays false while no node exists
  int phase = 0;               ///< the driver's idea of the rotor
  bool phase_on = false;       ///< power save: the next firing switches the coils off
  std::int64_t commanded = 0;  ///< steps counted by the driver, not wrapped

  /// Would it step on as before with that speed? Its coils alone are off until the next step, to which the
  /// rotor has come as far as it would.
  bool keeps_rhythm(int speed) const {
    return speed == speed_ && is_even() && !saves_power() && count.cycle == step_ticks_;
  }
  /// steps/s, clamped
  int speed() const { return speed_; }
  void set_speed(int speed) {
    disturb();
    speed_ = speed;
    magnitude_ = std::abs(speed);
    step_ticks_ = speed == 0 ? 0 : kSpeedUnit / magnitude_;
  }

  /// Ticks from step to step that the speed asks for; speed 0: 0.
  int step_ticks() const { return step_ticks_; }
  bool saves_power() const { return magnitude_ < kPowerSaveBelow; }

  /// What the agenda's function does once, at `at`. False: it divided by zero.
  bool fire(Cycle at, board::Stepper& stepper) {
    if (phase_on && saves_power()) {
      stepper.set_coils_only(0);
      phase_on = false;
      if (speed_ == 0) return false;
      set_cycle(step_ticks_ - kPowerSaveTicks);
      return true;
    }
    const int direction = step_direction();
    commanded += direction;
    phase = (phase + direction * forward_) & 3;
    stepper.energise(board::kPhaseCoils[phase], at);
    if (saves_power()) {
      phase_on = true;
      set_cycle(kPowerSaveTicks);
    }
    return true;
  }

  /// Processes all ticks up to `tick`; pins change at their ticks. Speed 0 is stepped by the
  /// caller, firing by firing.
  void advance_to(std::int64_t tick, const TickLine& line, board::Stepper& stepper) {
    if (tick <= count.tick) return;
    if (count.counts() && speed_ != 0 && tick - count.tick >= count.ticks_to_fire())
      step_to(tick, line, stepper);
    else
      count_idle(tick);
  }

  /// Ticks from one step to the next.
  std::int64_t full_period() const { return saves_power() ? step_ticks_ : count.cycle; }

  /// Does the wheel turn evenly until the next command? From the third step on, when each begins where the
  /// one before ended. (Before, the rotor is followed from step to step: how it catches up decides on the
  /// wheel's slip, half a per cent of the way where speeds are set 20 times a second.)
  bool is_even() const { return regular_ >= kRegularSteps; }
  /// left: forward only for v > 0; right: backward only for v < 0
  int step_direction() const {
    if (forward_ < 0) return speed_ > 0 ? 1 : -1;
    return speed_ < 0 ? -1 : 1;
  }
  /// Tick of the next step (not coil-off), or -1 if there is none without a command.
  std::int64_t next_step_tick() const {
    if (!count.counts() || speed_ == 0) return -1;
    std::int64_t next = count.tick + count.ticks_to_fire();
    if (phase_on && saves_power()) next += step_ticks_ - kPowerSaveTicks;
    return next;
  }

  void set_cycle(int cycle) { count.cycle = static_cast<std::uint16_t>(cycle); }

  /// Somebody changed speed, cycle, pins or phase: the rhythm has to be found again.
  void disturb() { regular_ = 0; }

 private:
  /// Steps in a row after which every one has had the time to finish: two that came a period after the one
  /// before. The last of them begins where the one before has ended, so it can be added up with what follows.
  static constexpr int kRegularSteps = 3;
  int forward_;
  int regular_ = 0;  // steps since the last command
  int speed_ = 0, magnitude_ = 0;
  int step_ticks_ = 0;  // from step to step, as the driver divides

  /// advance_to() where something fires.
  __attribute__((noinline)) void step_to(std::int64_t tick, const TickLine& line, board::Stepper& stepper) {
    const auto fire_at = [&](std::int64_t fire_tick) {
      count.tick = fire_tick;
      fire(line.cycle_of(fire_tick), stepper);
      count.counter = 0;
    };
    const std::int64_t period = full_period(), first = count.tick + count.ticks_to_fire();
    std::int64_t before_first = first - period;
    // a rotor that is where its driver believes it steps on at once: a new speed waits for at least its
    // period, and after two periods how the first steps began is forgotten
    const bool is_at_once = regular_ == 0 && !saves_power() && tick >= first + 2 * period &&
                            first > line.late_tick && stepper.is_at(phase);
    // otherwise firing by firing until driver, rotor and rhythm agree
    while (!is_at_once && regular_ < kRegularSteps - 1) {
      const std::int64_t fire_tick = count.tick + count.ticks_to_fire();
      if (fire_tick > tick) {
        count_idle(tick);
        return;
      }
      fire_at(fire_tick);
      if (!stepper.is_at(phase) || fire_tick <= line.late_tick)
        regular_ = 0;
      else if (phase_on_is_new())
        ++regular_;
    }
    // then all steps up to the last one at once: one every period
    if (!is_at_once) before_first = count.tick - count.counter - (phase_on_is_new() ? 0 : kPowerSaveTicks);
    const std::int64_t steps = board::quotient(tick - before_first, period);
    if (steps > 0) {
      regular_ = kRegularSteps;
      const int direction = step_direction(), turned = direction * forward_;
      const std::int64_t last_step = before_first + steps * period;
      commanded += steps * direction;
      phase = static_cast<int>((phase + steps * turned) & 3);
      const auto step_at = [&](int back) { return line.cycle_of(last_step - back * period); };
      stepper.turn(steps, direction, step_at(0), steps > 1 ? step_at(1) : 0, steps > 2 ? step_at(2) : 0,
                   board::kPhaseCoils[phase]);
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

  /// In a regular rhythm: was the last firing a step (true) or the coils' switching off?
  bool phase_on_is_new() const { return !saves_power() || phase_on; }
  void count_idle(std::int64_t tick) {
    if (count.counts()) count.counter = static_cast<std::uint16_t>(count.counter + (tick - count.tick));
    count.tick = tick;
  }
};

}  // namespace drivers
