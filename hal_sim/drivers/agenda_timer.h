// SPDX-License-Identifier: MIT
// Timer 2 and the agenda list of motor_led/advance_one_timer, in closed form.
//
//   tick:  1475 cycles; at each tick every active node with a cycle counts, newest first, and fires when its
//          counter reaches the cycle; the counter is zeroed after the callback has returned.
//
// Between two firings of user agendas nothing but counting and the motors' own firings can happen, and both
// have a closed form. So only ticks at which a user agenda fires become interrupts (next_interrupt()); the
// handler then walks the list with begin / next / finish, and what next() names is called.
// A handler that takes longer than a tick delays the following tick to its end and loses the others, as the
// processor with its single pending flag does; motors lose them too. So does a program that masks the handler
// (hold()). Motors' pins change at their nominal ticks, and behind a callback that takes longer than a tick when
// it returns.
//
// Modelled: list order, counters that survive speed and cycle changes, pause, restart, reset, destroy from
// within callbacks, lost ticks, division by zero in the power-save half.
// Not modelled: a list edited while the interrupt walks it (the robot races); use of freed nodes; what shorter
// callbacks earlier in the list and other handlers delay the pins by.
// Source: [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
#pragma once
#include <cstdint>
#include <optional>

#include "hal_sim/drivers/agenda_list.h"
#include "hal_sim/drivers/agenda_motors.h"
#include "hal_sim/drivers/agenda_shares.h"
#include "hal_sim/drivers/agenda_ticks.h"
#include "sim_core/base/hash.h"

namespace drivers {

class AgendaTimer {
 public:
  using Function = AgendaList::Function;

  /// The board's motors, left and right; they outlive this.
  explicit AgendaTimer(board::Stepper& left, board::Stepper& right);
  AgendaTimer(const AgendaTimer&) = delete;
  AgendaTimer& operator=(const AgendaTimer&) = delete;
  /// What the handler takes from now on; without it, nothing. They outlive this.
  void set_costs(const AgendaCosts& costs) { shares_.set_costs(costs); }
  /// The state's hash counts cycles from here on, so that one begun later has that of one begun at 0.
  void count_from(Cycle origin) { origin_ = origin; }

  // --- how things are
  const AgendaTicks& ticks() const { return ticks_; }
  const AgendaList& list() const { return list_; }
  const AgendaMotors& motors() const { return motors_; }
  const AgendaShares& shares() const { return shares_; }
  /// The state at `at` as a sum of products, for a hash: the caller mixes it.
  std::uint64_t state_sum(Cycle at) const;

  // --- the timer
  /// Timer 2 starts from 0: the first tick is one period later.
  void start(Cycle at);
  /// Timer 2 stops; nothing counts until the next start.
  void stop(Cycle at);
  /// Processor reset: list, statics and timer as after loading; wheels keep their position and
  /// lose their current.
  void reset(Cycle at);
  /// The driver's variables alone return to their start values: no agenda, speed 0. Timer and coils go on.
  void forget(Cycle at);

  /// From `at` on the handler is not called, because the program masks it; and is again.
  void hold(Cycle at) { ticks_.hold(at); }
  void release(Cycle at);
  /// Somebody else keeps the interrupt's flag, and tells of it: `pending`, it is set as the handler is let
  /// go. Then the handler begins once, whether a tick came meanwhile or the program has set the flag.
  void leave_flag_to_others() { ticks_.leave_flag_to_others(); }
  void release(Cycle at, bool pending);

  // --- the list; results as the C functions return them (1 done, 2 not found)
  int activate(Function function, int cycle, Cycle at);
  int destroy(Function function, Cycle at);
  int set_cycle(Function function, int cycle, Cycle at);
  int reset_count(Function function, Cycle at);
  int pause(Function function, Cycle at);
  int restart(Function function, Cycle at);
  /// Tells which functions are run_left_motor and run_right_motor, so that their firing is evaluated here.
  void name_motor(Wheel wheel, Function function) { list_.name_motor(wheel, function); }

  // --- motors
  /// e_set_speed_left / right: coils off, clamp, new cycle; the coils may be off before the cycle is new.
  /// False: the motor steps on as before, and all handlers come as before.
  bool set_speed(Wheel wheel, int speed, Cycle at, std::optional<Cycle> coils_off_at = {});
  /// run_left_motor() called as a function, from wherever. False: division by zero.
  bool run_motor(Wheel wheel, Cycle at);
  /// The motor itself, brought to `at`; changing it is up to the caller (pins written
  /// directly, other drivers).
  Stepper& stepper(Wheel wheel, Cycle at);

  // --- the interrupt handler
  /// The handler starts. Must be called at or after AgendaTicks::next_interrupt(), when a user agenda fires or
  /// a motor traps, or when it was let go as pending. One that has not finished never will: agendas that it
  /// has not come to have lost this tick.
  void begin(Cycle at);
  /// The next callback of this tick, in list order, or null when the list's end is reached; `at`, the one before
  /// has returned. `divided_by_zero` is set when a motor's firing trapped; the walk is then over.
  Function next(Cycle at, bool& divided_by_zero);
  /// Processor cycles that the walk has taken since this was asked last.
  Cycle take_walk_cost();
  /// The handler returns.
  void finish(Cycle at);

 private:
  using Node = AgendaList::Node;
  using Kind = AgendaList::Kind;
  enum class Command { Pins, Run, Destroy, SetCycle, ResetCount, Pause, Restart };
  void note(Command command, Cycle at) { note(static_cast<std::uint64_t>(command), at); }
  void note(std::uint64_t command, Cycle at) {
    history_ = sim::mix64(history_ ^ command << 48 ^ static_cast<std::uint64_t>(at - origin_));
  }
  template <typename Change>
  int change(Function function, Command command, Cycle at, const Change& change);
  void changed();
  void settle(Node& node, std::int64_t tick);
  void disturb(const Node& node);
  void walk_on(Cycle at);
  void resume(std::int64_t done, Cycle at);
  void resume(std::int64_t done, Cycle at, bool pending);
  void abandon(Cycle at);
  void lose(std::int64_t ticks);
  void find_next_fire();
  Cycle cost_of_firing(Node& node, std::int64_t tick);

  // what each look at the ticks needs lies together, with large swarms in mind
  AgendaTicks ticks_;
  AgendaMotors motors_;
  AgendaList list_;
  Cycle walk_cost_ = 0;        // since it was taken last
  bool pays_firings_ = false;  // the handler was held off, so no share has paid for the motors' firings
  std::uint64_t history_ = 0;  // of commands, for the hash
  Cycle origin_ = 0;           // ... which counts from here
  AgendaShares shares_;
};

}  // namespace drivers
