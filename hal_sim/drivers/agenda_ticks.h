// SPDX-License-Identifier: MIT
// Timer 2 under the library's agendas: which ticks the handler has processed by an instant, and how far it is
// in the one that it walks through.
//
//   Away --begin_walk()--> walking: walk_to() node by node --end_walk()--> Away
//
// A handler that takes longer than a tick delays the following tick to its end and loses the others, as the
// processor with its single pending flag does. So does a program that masks the handler (hold()). What the
// ticks mean to nodes and motors is AgendaTimer's affair.
#pragma once
#include <algorithm>
#include <cstdint>

#include "hal_sim/drivers/agenda_motor.h"

namespace drivers {

class AgendaTicks {
 public:
  /// No node has a serial as high.
  static constexpr std::uint32_t kBeforeAll = UINT32_MAX;

  bool is_running() const { return running_; }
  /// Ticks processed by `at`.
  std::int64_t at(Cycle at) const;
  /// Last tick that the node with this serial has processed at `at`.
  std::int64_t done(std::uint32_t serial, Cycle at) const {
    if (!walking_) return this->at(at);
    return serial >= walk_serial_ ? walk_tick_ : walk_tick_ - 1;
  }
  /// The first tick after `after`, whatever it finds; kNever: the timer stands.
  Cycle after(Cycle after) const {
    return running_ ? line_.origin + (came(0, after) + 1) * kAgendaTickCycles : kNever;
  }
  /// Cycle of the next tick that needs the handler; kNever: none does.
  Cycle next_interrupt() const {
    return !running_ || walking_ || next_fire_ < 0 ? kNever : line_.cycle_of(next_fire_);
  }
  /// The one that a handler which begins at `at` walks through.
  std::int64_t tick_due(Cycle at) const {
    return next_fire_ >= 0 && at >= next_interrupt() ? next_fire_ : this->at(at);
  }
  const TickLine& line() const { return line_; }
  /// Will no tick come by itself?
  bool stands() const { return (!running_ && !walking_) || held_since_ >= 0; }
  /// Ticks that were lost since the reset.
  std::int64_t lost() const { return lost_; }

  // --- the walk
  bool is_walking() const { return walking_; }
  /// Has it called a function that has not returned?
  bool is_calling() const { return in_callback_; }
  std::int64_t walk_tick() const { return walk_tick_; }
  /// Serial of the node being processed; those above are done.
  std::uint32_t walked() const { return walk_serial_; }
  void begin_walk(std::int64_t tick) {
    walk_tick_ = tick;
    walking_ = true;
    walk_to(kBeforeAll, false);
  }
  void walk_to(std::uint32_t serial, bool calls) {
    walk_serial_ = serial;
    in_callback_ = calls;
  }
  void end_walk() {
    walking_ = in_callback_ = false;
    stopped_tick_ = held_done_ = walk_tick_;
  }

  // --- for whoever has brought all that counts to `at`
  void start(Cycle at);
  void stop(Cycle at) {
    stopped_tick_ = this->at(at);
    running_ = false;
  }
  void reset();
  void hold(Cycle at) {
    if (held_since_ >= 0) return;
    held_done_ = this->at(at);
    held_since_ = at;
  }
  bool is_held() const { return held_since_ >= 0; }
  /// The walk that kept the handler ended at `at`: it is held only from then on.
  void hold_from(Cycle at) { held_since_ = at; }
  /// The handler is let go. Returns the ticks processed by then.
  std::int64_t let_go() {
    const std::int64_t done = has_no_flag_ ? held_done_ : at(held_since_);
    held_since_ = -1;
    return done;
  }
  void leave_flag_to_others() { has_no_flag_ = true; }
  bool has_no_flag() const { return has_no_flag_; }
  /// While the timer stands: the handler comes once more.
  void count_stopped(std::int64_t tick) { stopped_tick_ = tick; }
  /// Ticks behind tick `done` that have come by `at`.
  std::int64_t came(std::int64_t done, Cycle at) const {
    const Cycle since = at - (line_.origin + done * kAgendaTickCycles);
    if (since >= 0) return static_cast<std::int64_t>(static_cast<std::uint64_t>(since) / kAgendaTickCycles);
    return -((kAgendaTickCycles - 1 - since) / kAgendaTickCycles);
  }
  /// Ticks that never come; below 0: more than come by themselves.
  void lose(std::int64_t ticks) {
    line_.origin += ticks * kAgendaTickCycles;
    lost_ += std::max<std::int64_t>(ticks, 0);
  }
  void come_late(std::int64_t tick, Cycle at) {
    line_.late_tick = tick;
    line_.late_cycle = at;
  }
  /// Next tick that needs the handler, -1: none.
  void set_next_fire(std::int64_t tick) { next_fire_ = tick; }

 private:
  TickLine line_;
  std::int64_t next_fire_ = -1;
  Cycle held_since_ = -1;       // -1: not held
  std::int64_t held_done_ = 0;  // ticks processed then
  std::int64_t walk_tick_ = 0;
  std::uint32_t walk_serial_ = 0;
  bool running_ = false, walking_ = false, in_callback_ = false, has_no_flag_ = false;
  std::int64_t stopped_tick_ = 0;  // ticks processed while not running
  std::int64_t lost_ = 0;
};

__attribute__((always_inline)) inline std::int64_t AgendaTicks::at(Cycle at) const {
  if (walking_) return walk_tick_;
  if (!running_) return stopped_tick_;
  if (held_since_ >= 0 && has_no_flag_) return held_done_;
  if (held_since_ >= 0) at = std::min(at, held_since_);
  std::int64_t tick = came(0, at);
  if (tick < line_.late_tick) tick = at >= line_.late_cycle ? line_.late_tick : line_.late_tick - 1;
  if (tick == line_.late_tick && at < line_.late_cycle) tick = line_.late_tick - 1;
  // the handler is due: until it has begun, the interrupt is pending and nothing counts
  if (next_fire_ >= 0 && tick >= next_fire_) tick = next_fire_ - 1;
  return tick;
}

}  // namespace drivers
