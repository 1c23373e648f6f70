// SPDX-License-Identifier: MIT
// The instants at which peripherals do something by themselves: one slot each, served in order of time, equal
// times in order of the slots. What happens between two instants is a closed form of its owner.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "dspic30/memory/cycle.h"

namespace dspic {

class EventOwner {
 public:
  virtual ~EventOwner() = default;
  /// The slot's instant `at` has come; the slot is empty now and may be set again, to `at` or later.
  virtual void on_event(int id, Cycle at) = 0;
};

/// Hears of every instant before anything happens in it: whoever draws registers over time.
class EventWatch {
 public:
  virtual ~EventWatch() = default;
  /// The chip changes by itself in cycle `at`; all that changed before is in place. May peek, not change.
  virtual void about_to_change(Cycle at) = 0;
};

class Events {
 public:
  static constexpr int kMostSlots = 64;

  /// `irqs`: bit i if the event may set the flag of IRQ i; `outward`: it may move a pin or ask for a reset.
  int add(EventOwner& owner, int id, std::uint64_t irqs, bool outward) {
    slots_[static_cast<std::size_t>(count_)] = {&owner, id, irqs};
    outward_ |= static_cast<std::uint64_t>(outward) << count_;
    when_[static_cast<std::size_t>(count_)] = kNever;
    return count_++;
  }

  void set(int slot, Cycle at) {
    const auto s = static_cast<std::size_t>(slot);
    const Cycle before = when_[s];
    if (before == at) return;
    when_[s] = at;
    const std::uint64_t bit = std::uint64_t{1} << s;
    active_ = at < kNever ? active_ | bit : active_ & ~bit;
    if (noticed_ & bit) {
      if (at < before) {
        earliest_ = std::min(earliest_, at + delay(slot));
        notice_ = std::min(notice_, at + delay(slot));
      } else {
        put_off_ = true;
        notice_known_ &= notice_ != before + delay(slot);
      }
    }
    if (at < next_)
      next_ = at;
    else if (before == next_)
      refresh();
  }
  Cycle when(int slot) const { return when_[static_cast<std::size_t>(slot)]; }
  Cycle next() const { return next_; }

  void run_to(Cycle now) {
    if (next_ <= now) serve_to(now);
    reached_ = std::max(reached_, now);
  }
  /// run_to() where it is already known that next() > now.
  void pass_to(Cycle now) { reached_ = std::max(reached_, now); }
  /// set() of a slot that is empty, as in its own on_event(), to an instant that comes.
  void fill(int slot, Cycle at) {
    const auto s = static_cast<std::size_t>(slot);
    const std::uint64_t bit = std::uint64_t{1} << s;
    when_[s] = at;
    active_ |= bit;
    if (noticed_ & bit) {
      earliest_ = std::min(earliest_, at + delay(slot));
      notice_ = std::min(notice_, at + delay(slot));
    }
    next_ = std::min(next_, at);
  }
  /// Null: nobody.
  void watch(EventWatch* watch) { watch_ = watch; }
  /// What next_notice(), asked before with the same flags, answers now is the earlier one of its last answer
  /// and earliest(), if nothing has happened since forget_changes() but what was set; was_put_off(): it may
  /// be later.
  Cycle earliest() const { return earliest_; }
  bool was_put_off() const { return put_off_; }
  void forget_changes() {
    earliest_ = kNever;
    put_off_ = false;
  }
  /// Everything up to here has happened.
  Cycle reached() const { return reached_; }

  /// Earliest instant at which the processor may notice something: a slot that acts outwards, or one cycle
  /// after a slot that may set one of these flags.
  Cycle next_notice(std::uint64_t irqs) {
    if (irqs != noticed_irqs_) find_noticed(irqs);
    if (!notice_known_) find_notice();
    return notice_;
  }
  /// Earliest instant of a slot that may set one of these flags.
  Cycle next_for(std::uint64_t irqs) const {
    Cycle next = kNever;
    for (std::uint64_t rest = active_; rest; rest &= rest - 1) {
      const auto s = static_cast<std::size_t>(__builtin_ctzll(rest));
      if (slots_[s].irqs & irqs) next = std::min(next, when_[s]);
    }
    return next;
  }

 private:
  Cycle delay(int slot) const { return static_cast<Cycle>(~outward_ >> slot & 1); }
  void find_noticed(std::uint64_t irqs) {
    noticed_irqs_ = irqs;
    noticed_ = outward_;
    for (int s = 0; s < count_; ++s)
      if (slots_[static_cast<std::size_t>(s)].irqs & irqs) noticed_ |= std::uint64_t{1} << s;
    notice_known_ = false;
  }
  void find_notice() {
    notice_known_ = true;
    notice_ = kNever;
    for (std::uint64_t rest = active_ & noticed_; rest; rest &= rest - 1) {
      const int s = __builtin_ctzll(rest);
      notice_ = std::min(notice_, when_[static_cast<std::size_t>(s)] + delay(s));
    }
  }
  void refresh() {
    next_ = kNever;
    for (std::uint64_t rest = active_; rest; rest &= rest - 1)
      next_ = std::min(next_, when_[static_cast<std::size_t>(__builtin_ctzll(rest))]);
  }
  __attribute__((noinline)) void serve_to(Cycle now) {
    while (next_ <= now) serve();
  }
  void serve() {
    const Cycle at = next_;
    if (watch_) watch_->about_to_change(at);
    // the first slot of this instant, and what comes after it
    std::size_t slot = kMostSlots;
    Cycle next = kNever, notice = kNever;
    for (std::uint64_t rest = active_; rest; rest &= rest - 1) {
      const int s = __builtin_ctzll(rest);
      const Cycle when = when_[static_cast<std::size_t>(s)];
      if (when == at && slot == kMostSlots) {
        slot = static_cast<std::size_t>(s);
        continue;
      }
      next = std::min(next, when);
      if (noticed_ >> s & 1) notice = std::min(notice, when + delay(s));
    }
    const std::uint64_t bit = std::uint64_t{1} << slot;
    next_ = next;
    notice_ = notice;
    notice_known_ = true;
    put_off_ |= (noticed_ & bit) != 0;
    when_[slot] = kNever;
    active_ &= ~bit;
    slots_[slot].owner->on_event(slots_[slot].id, at);
  }

  struct Slot {
    EventOwner* owner = nullptr;
    int id = 0;
    std::uint64_t irqs = 0;
  };
  std::array<Cycle, kMostSlots> when_{};
  std::array<Slot, kMostSlots> slots_{};
  std::uint64_t active_ = 0;   // slots whose instant is known
  std::uint64_t outward_ = 0;  // slots that act outwards
  // of next_notice(), for the flags of its last call; at the beginning for none
  std::uint64_t noticed_ = 0, noticed_irqs_ = ~std::uint64_t{0};
  Cycle notice_ = kNever;  // its answer, while it is known
  bool notice_known_ = false;
  int count_ = 0;
  Cycle next_ = kNever;
  Cycle reached_ = 0;
  EventWatch* watch_ = nullptr;
  Cycle earliest_ = kNever;
  bool put_off_ = false;
};

}  // namespace dspic
