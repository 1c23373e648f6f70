// SPDX-License-Identifier: MIT
// What the agendas' handler takes of the processor's time, worked out when somebody asks after the list, a
// cycle or a speed has changed.
#pragma once
#include <cstdint>
#include <utility>

#include "hal_sim/drivers/agenda_list.h"
#include "hal_sim/drivers/agenda_motors.h"
#include "hal_sim/drivers/agenda_ticks.h"

namespace drivers {

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

class AgendaShares {
 public:
  /// All outlive this.
  AgendaShares(const AgendaTicks& ticks, const AgendaList& list, const AgendaMotors& motors);

  /// What the ticks take of each cycle that call no function of the program, as a fraction of 2^32; those
  /// that do are run and charged one by one.
  std::uint64_t share_q32() const {
    if (!ticks_.is_running()) return 0;
    if (known_ != kAll) find();
    return tick_share_q32_ + motor_share_q32_[0] + motor_share_q32_[1];
  }
  /// What a tick takes that calls nothing and in which no motor fires; 0: the timer stands.
  Cycle tick_cycles() const {
    if (!ticks_.is_running()) return 0;
    if (!(known_ & kTicks)) find();
    return tick_cycles_;
  }
  /// The part of it that ticks take which do call one, so that these may be charged in full.
  std::uint64_t calling_share_q32() const {
    if (!ticks_.is_running()) return 0;
    if (known_ != kAll) find();
    return calling_share_q32_;
  }

  /// What the handler takes from now on. They outlive this.
  void set_costs(const AgendaCosts& costs) {
    costs_ = &costs;
    change();
  }
  const AgendaCosts& costs() const { return *costs_; }
  /// Of a node in a walk.
  Cycle cost_of(const AgendaList::Node& node) const {
    const AgendaCount& count = motors_.count_of(node);
    return !count.active ? costs_->paused : count.cycle == 0 ? costs_->resting : costs_->counts;
  }
  /// The list, or a cycle has changed.
  void change() {
    known_ = 0;
    forget_firings();
  }
  /// This motor's speed has; and its node counts, or no longer does.
  void change_motor(board::Wheel wheel, bool counts_otherwise) {
    known_ &= ~((counts_otherwise ? kTicks : 0) | 1u << static_cast<unsigned>(wheel));
  }

  // --- what a share does not tell
  // A motor's firings are charged as if they came evenly from its command on. The first one comes earlier or later;
  // with speeds that are set in each turn of a loop that is 0.5 % of all time.
  /// From `at` on the motor's firings are counted, as far as the share is what is taken.
  void count_firings(board::Wheel wheel, Cycle at);
  /// Another command comes: what was taken too little until `at`.
  void settle_firings(board::Wheel wheel, Cycle at);
  /// Ticks are lost: nobody knows. (While the handler is held for less than a tick nothing is taken: a share of a
  /// share.)
  void forget_firings() { counted_from_[0] = counted_from_[1] = kNever; }
  /// What was taken too little by now, in cycles of 2^-32; negative: too much.
  std::int64_t take_owed_q32() const { return std::exchange(owed_q32_, 0); }

 private:
  static constexpr unsigned kTicks = 4, kAll = 7;  // bits 0 and 1: the motors
  void find() const;
  std::uint64_t calling_ticks_q32() const;

  const AgendaTicks& ticks_;
  const AgendaList& list_;
  const AgendaMotors& motors_;
  const AgendaCosts* costs_;
  mutable unsigned known_ = 0;
  mutable std::uint64_t tick_share_q32_ = 0, calling_share_q32_ = 0, motor_share_q32_[2] = {0, 0};
  mutable Cycle tick_cycles_ = 0;
  Cycle counted_from_[2] = {kNever, kNever};
  std::int64_t commanded_[2] = {0, 0};  // then
  bool phase_on_[2] = {false, false};   // likewise
  mutable std::int64_t owed_q32_ = 0;
};

}  // namespace drivers
