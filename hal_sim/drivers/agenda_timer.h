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
// (hold()). Motors' pins change at their nominal ticks.
//
// Modelled: list order, counters that survive speed and cycle changes, pause, restart, reset, destroy from
// within callbacks, lost ticks, division by zero in the power-save half.
// Not modelled: a list edited while the interrupt walks it (the robot races); use of freed nodes; what nodes
// earlier in the list and other handlers delay the pins by.
// Source: [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
#pragma once
#include <cstdint>
#include <vector>

#include "hal_sim/board/pin_driver.h"
#include "hal_sim/drivers/agenda_motor.h"
#include "sim_core/base/hash.h"

namespace drivers {

using board::Stepper;
using board::Wheel;

/// What the handler takes, in processor cycles; all 0 where no program's time is counted.
struct AgendaCosts {
  // a tick that calls nothing, entry and RETFIE included: without agendas, with some beside the nodes' own
  Cycle empty = 0, list = 0;
  // each node of a walk that is paused, has no cycle, counts
  Cycle paused = 0, resting = 0, counts = 0;
  // of a walk: a node whose function is called, which has returned, whose node it has destroyed
  Cycle fires = 0, after = 0, after_destroyed = 0;
  Cycle motor_half = 0, motor_off = 0, motor_step = 0;
};

class AgendaTimer {
 public:
  /// Identifies an agenda: the address of its C function. Only compared, never followed here.
  using Function = const void*;

  /// The board's motors, left and right; they outlive this.
  explicit AgendaTimer(board::Stepper& left, board::Stepper& right);
  /// What the handler takes from now on; without it, nothing. They outlive this.
  void set_costs(const AgendaCosts& costs) {
    costs_ = &costs;
    shares_known_ = 0;
  }
  /// The state's hash counts cycles from here on, so that one begun later has that of one begun at 0.
  void count_from(Cycle origin) { origin_ = origin; }

  // --- the timer
  /// Timer 2 starts from 0: the first tick is one period later.
  void start(Cycle at);
  /// Timer 2 stops; nothing counts until the next start.
  void stop(Cycle at);
  bool is_running() const { return running_; }
  /// Processor reset: list, statics and timer as after loading; wheels keep their position and
  /// lose their current.
  void reset(Cycle at);
  /// The driver's variables alone return to their start values: no agenda, speed 0. Timer and coils go on.
  void forget(Cycle at);

  /// From `at` on the handler is not called, because the program masks it; and is again.
  void hold(Cycle at) {
    if (held_since_ >= 0) return;
    held_done_ = ticks_at(at);
    held_since_ = at;
  }
  void release(Cycle at);
  /// Somebody else keeps the interrupt's flag, and tells of it: `pending`, it is set as the handler is let
  /// go. Then the handler begins once, whether a tick came meanwhile or the program has set the flag.
  void leave_flag_to_others() { has_no_flag_ = true; }
  void release(Cycle at, bool pending);
  /// The first tick after `after`, whatever it finds; kNever: the timer stands.
  Cycle tick_after(Cycle after) const;
  /// Ticks that were lost because the handler was busy or masked for longer than a tick, since the reset.
  std::int64_t lost_ticks() const { return lost_ticks_; }

  // --- the list; results as the C functions return them (1 done, 2 not found)
  int activate(Function function, int cycle, Cycle at);
  int destroy(Function function, Cycle at);
  int set_cycle(Function function, int cycle, Cycle at);
  int reset_count(Function function, Cycle at);
  int pause(Function function, Cycle at);
  int restart(Function function, Cycle at);
  /// Tells which functions are run_left_motor and run_right_motor, so that their firing is evaluated here.
  void name_motor(Wheel wheel, Function function);

  // --- motors
  /// e_set_speed_left / right: coils off, clamp, new cycle; the coils may be off before the cycle is new.
  void set_speed(Wheel wheel, int speed, Cycle at) { set_speed(wheel, speed, at, at); }
  void set_speed(Wheel wheel, int speed, Cycle coils_off_at, Cycle at);
  /// run_left_motor() called as a function, from wherever. False: division by zero.
  bool run_motor(Wheel wheel, Cycle at);
  /// Would that switch the coils off, rather than step?
  bool switches_off(Wheel wheel, Cycle at) const {
    return motor_at(wheel, at).phase_on && motor(wheel).saves_power();
  }
  /// steps/s
  int speed(Wheel wheel) const { return motor(wheel).speed(); }
  /// The driver's step counter, not wrapped.
  std::int64_t commanded_steps(Wheel wheel, Cycle at) const;
  /// Cycle before which the step counter keeps its value without a command.
  Cycle steps_horizon(Wheel wheel, Cycle at) const { return next_step(motor_at(wheel, at)); }
  /// How the wheel turns on: once it does so evenly (AgendaMotor::is_even()), for ever; before, and when it
  /// rests between steps, up to the next step.
  board::RotorCourse course(Wheel wheel, Cycle at) const;
  /// Cycle before which the coils keep their state without a command.
  Cycle coils_horizon(Wheel wheel, Cycle at) const;
  /// The motor as it is at `at`, which is not before the last instant that anybody asked for.
  const Stepper& stepper_at(Wheel wheel, Cycle at) const;
  /// The motor itself, brought to `at`; changing it is up to the caller (pins written
  /// directly, other drivers).
  Stepper& stepper(Wheel wheel, Cycle at);

  // --- the interrupt handler
  /// Cycle of the next tick at which a user agenda fires (or a motor traps); kNever if none.
  Cycle next_interrupt() const;
  /// The handler starts. Must be called at or after next_interrupt(), or when it was let go as pending. One
  /// that has not finished never will: agendas that it has not come to have lost this tick.
  void begin(Cycle at);
  /// The next callback of this tick, in list order, or null when the list's end is reached. `divided_by_zero`
  /// is set when a motor's firing trapped; the walk is then over.
  Function next(bool& divided_by_zero);
  /// Processor cycles that the walk has taken since this was asked last.
  Cycle take_walk_cost();
  /// The handler returns.
  void finish(Cycle at);
  bool is_walking() const { return walking_; }

  /// Nodes that a search for this function passes before it finds its own: those added later;
  /// all when it has none.
  int nodes_passed(Function function) const;
  bool is_motor(Function function) const {
    return function && (function == motor_functions_[0] || function == motor_functions_[1]);
  }
  int nodes() const { return static_cast<int>(nodes_.size()); }
  /// The function that runs, while its node is there; which comes next in the walk. Null: none.
  Function running() const;
  Function following() const;
  bool has(Function function) const { return nodes_passed(function) < static_cast<int>(nodes_.size()); }
  int nodes_passed(Wheel wheel) const { return nodes_passed(motor_functions_[static_cast<int>(wheel)]); }

  /// Ticks processed by `at`.
  std::int64_t ticks_at(Cycle at) const;
  /// What the ticks take of each cycle that call no function of the program, as a fraction of 2^32; those
  /// that do are run and charged one by one.
  std::uint64_t share_q32() const {
    if (!running_) return 0;
    if (shares_known_ != kAllShares) find_shares();
    return tick_share_q32_ + motor_share_q32_[0] + motor_share_q32_[1];
  }
  /// What a tick takes that calls nothing and in which no motor fires; 0: the timer stands.
  Cycle tick_cycles() const {
    if (!running_) return 0;
    if (!(shares_known_ & kTicks)) find_shares();
    return tick_cycles_;
  }
  /// The part of it that ticks take which do call one, so that these may be charged in full.
  std::uint64_t calling_share_q32() const {
    if (!running_) return 0;
    if (shares_known_ != kAllShares) find_shares();
    return calling_share_q32_;
  }
  /// Does the driver step this wheel on and on?
  bool runs(Wheel wheel) const {
    return running_ && motor(wheel).count.counts() && motor(wheel).speed() != 0;
  }
  /// The state at `at` as a sum of products, for a hash: the caller mixes it.
  std::uint64_t state_sum(Cycle at) const;

 private:
  enum class Kind : std::uint8_t { User, Left, Right };
  struct Node {
    Function function = nullptr;
    std::uint32_t serial = 0;  // grows with each activation: the list's order, newest first
    Kind kind = Kind::User;
    AgendaCount count;  // of user nodes; motors keep theirs in AgendaMotor
  };

  AgendaMotor& motor(Wheel wheel) { return motors_[static_cast<int>(wheel)]; }
  const AgendaMotor& motor(Wheel wheel) const { return motors_[static_cast<int>(wheel)]; }
  static Wheel wheel_of(Kind kind) { return kind == Kind::Left ? Wheel::Left : Wheel::Right; }

  Node* find(Function function);
  AgendaCount& count_of(Node& node);
  const AgendaCount& count_of(const Node& node) const;
  /// Last tick that the node with this serial has processed at `at`.
  std::int64_t done_tick(std::uint32_t serial, Cycle at) const;
  void settle(Node& node, std::int64_t tick);
  void settle_motors(std::int64_t tick);
  void settle_motors_at(Cycle at);
  void disturb(const Node& node);
  enum class Command { Pins, Run, Destroy, SetCycle, ResetCount, Pause, Restart };
  void note(Command command, Cycle at) { note(static_cast<std::uint64_t>(command), at); }
  void note(std::uint64_t command, Cycle at) {
    history_ = sim::mix64(history_ ^ command << 48 ^ static_cast<std::uint64_t>(at - origin_));
  }
  /// The motor, brought to `tick`. Nothing that follows is earlier, whoever asks.
  AgendaMotor& bring(Wheel wheel, std::int64_t tick) const {
    AgendaMotor& m = motors_[static_cast<std::size_t>(wheel)];
    m.advance_to(tick, line_, *steppers_[static_cast<std::size_t>(wheel)]);
    return m;
  }
  std::uint32_t serial_of(Wheel wheel) const { return motor_serial_[static_cast<int>(wheel)]; }
  const AgendaMotor& motor_at(Wheel wheel, Cycle at) const {
    return bring(wheel, done_tick(serial_of(wheel), at));
  }
  Cycle next_step(const AgendaMotor& motor) const;
  Stepper& stepper(Wheel wheel) { return *steppers_[static_cast<int>(wheel)]; }
  /// Does this node need the handler when it fires?
  bool needs_handler(const Node& node) const;
  Cycle cost_of(const Node& node) const;
  const Node* node_of(std::uint32_t serial) const;
  void resume(std::int64_t done, Cycle at);
  void resume(std::int64_t done, Cycle at, bool pending);
  void abandon(Cycle at);
  void lose(std::int64_t ticks);
  void find_next_fire();
  void find_shares() const;
  std::uint64_t calling_ticks_q32() const;

  // what each look at the ticks needs lies together, with large swarms in mind
  TickLine line_;
  std::int64_t next_fire_ = -1;  // next tick that needs the handler, -1 none
  Cycle held_since_ = -1;        // -1: not held
  std::int64_t held_done_ = 0;   // ticks processed then
  std::int64_t walk_tick_ = 0;
  std::uint32_t walk_serial_ = 0;  // node being processed; those above are done
  bool running_ = false, walking_ = false, in_callback_ = false;
  bool has_no_flag_ = false, has_node_[2] = {false, false};
  std::uint32_t motor_serial_[2] = {0, 0};
  std::vector<Node> nodes_;  // oldest first; the list is walked from the back
  Cycle walk_cost_ = 0;      // since it was taken last
  const AgendaCosts* costs_;
  board::Stepper* steppers_[2];
  mutable AgendaMotor motors_[2];  // as far as somebody has asked: when changes no answer
  std::uint64_t history_ = 0;      // of commands, for the hash
  Cycle origin_ = 0;               // ... which counts from here

  static constexpr unsigned kTicks = 4, kAllShares = 7;  // bits 0 and 1: the motors
  mutable unsigned shares_known_ = 0;  // cleared when the list, a cycle or a speed has changed
  mutable std::uint64_t tick_share_q32_ = 0, calling_share_q32_ = 0, motor_share_q32_[2] = {0, 0};
  mutable Cycle tick_cycles_ = 0;

  Function motor_functions_[2] = {nullptr, nullptr};
  std::uint32_t last_serial_ = 0;
  std::int64_t stopped_tick_ = 0;  // ticks processed while not running
  std::int64_t lost_ticks_ = 0;
};

}  // namespace drivers
