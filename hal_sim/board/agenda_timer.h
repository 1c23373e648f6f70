// SPDX-License-Identifier: MIT
// Timer 2 and the agenda list of motor_led/advance_one_timer, in closed form.
//
//   tick:  1475 cycles; at each tick every active node with a cycle counts, newest first, and fires when its
//          counter reaches the cycle; the counter is zeroed after the callback has returned.
//
// Between two firings of user agendas nothing but counting and the motors' own firings can happen, and both
// have a closed form. So only ticks at which a user agenda fires become interrupts (next_interrupt()); the
// handler in the image then walks the list with begin / next / finish and calls what next() names.
// A handler that takes longer than a tick delays the following tick to its end and loses the others, as the
// processor with its single pending flag does; motors lose them too.
//
// A motor's pins change when the handler comes to them: after the nodes that were added later, the other
// motor's firing if that is one of them, and the converter's handlers that come meanwhile.
//
// Modelled: list order, counters that survive speed and cycle changes, pause, restart, reset, destroy from
// within callbacks, lost ticks, division by zero in the power-save half.
// Not modelled: a list edited while the interrupt walks it (the robot races); use of freed nodes; ticks lost
// to other interrupts while no user agenda is due, or delayed by other handlers than the converter's.
// Source: [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "hal_sim/board/agenda_motor.h"

namespace board {

class AdcScan;

enum class Wheel { Left = 0, Right = 1 };

class AgendaTimer {
 public:
  /// Identifies an agenda: the address of its C function. Only compared, never followed here.
  using Function = const void*;

  /// `scan`: whose handler interrupts that of the agendas; null: motors' pins change at their ticks, whatever
  /// handlers do.
  explicit AgendaTimer(const AdcScan* scan = nullptr);

  // --- the timer -----------------------------------------------------------------------------------------
  /// Timer 2 starts from 0: the first tick is one period later.
  void start(Cycle at);
  /// Timer 2 stops; nothing counts until the next start.
  void stop(Cycle at);
  bool is_running() const { return running_; }
  /// Has it ever been started since the last reset: is its interrupt enabled?
  bool is_enabled() const { return enabled_; }
  /// Processor reset: list, statics and timer as after loading; wheels keep their position and lose their
  /// current.
  void reset(Cycle at);

  // --- the list; results as the C functions return them (1 done, 2 not found) ----------------------------
  int activate(Function function, int cycle, Cycle at);
  int destroy(Function function, Cycle at);
  int set_cycle(Function function, int cycle, Cycle at);
  int reset_count(Function function, Cycle at);
  int pause(Function function, Cycle at);
  int restart(Function function, Cycle at);
  /// Tells which functions are run_left_motor and run_right_motor, so that their firing is evaluated here.
  void name_motor(Wheel wheel, Function function);

  // --- motors --------------------------------------------------------------------------------------------
  /// e_set_speed_left / right: coils off, clamp, new cycle.
  void set_speed(Wheel wheel, int speed, Cycle at);
  /// run_left_motor() called as a function, from wherever. False: division by zero.
  bool run_motor(Wheel wheel, Cycle at);
  int speed(Wheel wheel) const { return motor(wheel).speed(); }
  /// The driver's step counter, not wrapped.
  std::int64_t commanded_steps(Wheel wheel, Cycle at) const;
  /// Cycle before which the step counter keeps its value without a command.
  Cycle steps_horizon(Wheel wheel, Cycle at) const;
  /// Cycle before which the coils keep their state without a command.
  Cycle coils_horizon(Wheel wheel, Cycle at) const;
  /// The motor as it is at `at`; valid until the next call of anything here.
  const Stepper& stepper_at(Wheel wheel, Cycle at) const;
  /// The motor itself, brought to `at`; changing it is up to the caller (pins written directly, other
  /// drivers).
  Stepper& stepper(Wheel wheel, Cycle at);

  /// Does this driver leave the wheel alone until somebody commands it?
  bool rests(Wheel wheel) const { return !motor(wheel).count.counts(); }
  /// stepper() of a robot that never runs this driver.
  Stepper& stepper_by_pins(Wheel wheel) { return motor(wheel).stepper; }

  // --- the interrupt handler -----------------------------------------------------------------------------
  /// Cycle of the next tick at which a user agenda fires (or a motor traps); kNever if none.
  Cycle next_interrupt() const;
  /// The handler starts. Must be called at or after next_interrupt().
  void begin(Cycle at);
  /// The next callback of this tick, in list order, or null when the list's end is reached. `divided_by_zero`
  /// is set when a motor's firing trapped; the walk is then over. `at`: now.
  Function next(bool& divided_by_zero, Cycle at);
  /// Processor cycles that the walk has taken since this was asked last.
  Cycle take_walk_cost();
  /// The handler returns.
  void finish(Cycle at);
  bool is_walking() const { return walking_; }

  /// Nodes that a search for this function passes before it finds its own: those added later; all when it has
  /// none.
  int nodes_passed(Function function) const;
  bool is_motor(Function function) const {
    return function && (function == motor_functions_[0] || function == motor_functions_[1]);
  }
  bool has(Function function) const { return nodes_passed(function) < static_cast<int>(nodes_.size()); }
  int nodes_passed(Wheel wheel) const { return nodes_passed(motor_functions_[static_cast<int>(wheel)]); }

  /// Ticks processed by `at`.
  std::int64_t ticks_at(Cycle at) const;
  /// Cycles that the ticks in [from, to) take which call no function of the program; those that do are run
  /// and charged one by one. 0 during a walk.
  Cycle handler_cycles(Cycle from, Cycle to) const;
  /// What all of them take of each cycle on average, as a fraction of 2^32.
  std::uint64_t share_q32() const;
  /// When the newest of them before `at` came; below 0: none.
  Cycle last_call(Cycle at) const;
  Cycle next_call(Cycle at) const;
  /// Cycles from a tick to `at`, an instant after the first.
  Cycle since_tick(Cycle at) const { return (at - line_.origin) % kAgendaTickCycles; }
  /// An interrupt of a higher level that must wait because the processor is on its way into the handler or
  /// out of it.
  struct Wait {
    std::int64_t round = 0;
    Cycle cycles = 0;  ///< 0: none must
  };
  /// Of interrupts asked for at `at`, `since` after a tick, and then once a round of the scan, `rounds` times
  /// more: the first that must wait. Not before the last settle().
  Wait first_wait(Cycle at, Cycle since, std::int64_t rounds) const;
  /// False: none must at `since` plus multiples of kPhaseCycles.
  bool may_delay(Cycle since) const { return (delayed_phases_ >> (since % kPhaseCycles) & 1) != 0; }
  /// Brings the motors to `at`: whatever changes how long handlers take, or delay each other, comes after.
  void settle(Cycle at) { settle_motors(walking_ ? -1 : ticks_at(at)); }
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
  void disturb(const Node& node);
  /// The motor itself, brought to `tick`.
  AgendaMotor& bring(Wheel wheel, std::int64_t tick);
  std::uint32_t serial_of(Wheel wheel) const { return motor_serial_[static_cast<int>(wheel)]; }
  /// The motor as it is at `at`: itself, or the copy kept for looking ahead.
  const AgendaMotor& motor_at(Wheel wheel, Cycle at) const;
  /// Does this node need the handler when it fires?
  bool needs_handler(const Node& node) const;
  Cycle cost_of(const Node& node) const;
  void find_costs();
  void find_moments();
  Cycle wait_at(Cycle at, Cycle since) const;
  /// Firings of both motors in the ticks after `from` up to `to`, and what they take.
  Cycle firing_cycles(std::int64_t from, std::int64_t to) const;
  /// When the firing of a motor at `tick` changes its last pin, `cycles` after its function's call.
  Cycle pins_at(Wheel wheel, std::int64_t tick, Cycle cycles) const;
  bool walks_before(Wheel first, Wheel second) const { return serial_of(first) > serial_of(second); }
  AgendaMotor& bring_alone(Wheel wheel, std::int64_t tick);
  void advance(AgendaMotor& m, Wheel wheel, std::int64_t tick) const;
  void find_next_fire();

  const AdcScan* scan_;
  TickLine line_;
  bool running_ = false, enabled_ = false;
  std::int64_t started_tick_ = 0;  // the first call is that of the tick after this
  std::int64_t stopped_tick_ = 0;  // ticks processed while not running
  std::vector<Node> nodes_;        // oldest first; the list is walked from the back
  AgendaMotor motors_[2];
  // what queries have computed ahead of the last command; a cache, its presence changes no answer
  mutable AgendaMotor ahead_[2];
  mutable bool has_ahead_[2] = {false, false};
  bool has_node_[2] = {false, false};
  Function motor_functions_[2] = {nullptr, nullptr};
  std::uint32_t motor_serial_[2] = {0, 0};
  std::uint32_t last_serial_ = 0;

  Cycle tick_cycles_ = kAgendaIsrCycles;  // of a tick at which nothing fires
  // moments after a tick at which another interrupt may have to wait
  std::int16_t moments_[kEntryCycles + 16 * kExitCycles] = {};
  int moment_count_ = 0;
  std::array<Cycle, 5> moments_key_{};  // what they were found for
  std::uint32_t delayed_phases_ = 0;    // may_delay()'s bits
  Cycle way_to_[2] = {0, 0};            // from the list's head to the motors' functions

  std::int64_t next_fire_ = -1;  // next tick that needs the handler, -1 none
  bool walking_ = false;
  std::int64_t walk_tick_ = 0;
  std::uint32_t walk_serial_ = 0;  // node being processed; those above are done
  Cycle walk_cost_ = 0;            // of the nodes since walk_at_
  Cycle walk_at_ = 0;
  bool in_callback_ = false;
};

}  // namespace board
