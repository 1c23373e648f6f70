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
    const Cycle before = when(slot);
    if (before == at) return;
    if (before < kNever) remove(slot);
    when_[static_cast<std::size_t>(slot)] = at;
    if (at < kNever) insert(slot, at);
    if (!is_noticed(slot)) return;
    if (at < before)
      earliest_ = std::min(earliest_, at + delay(slot));
    else
      put_off_ = true;
  }
  Cycle when(int slot) const { return when_[static_cast<std::size_t>(slot)]; }
  Cycle next() const { return queue_[0].at; }

  void run_to(Cycle now) {
    if (next() <= now) serve_to(now);
    reached_ = std::max(reached_, now);
  }
  /// set() of a slot that is empty, as in its own on_event(), to an instant that comes.
  void fill(int slot, Cycle at) {
    when_[static_cast<std::size_t>(slot)] = at;
    insert(slot, at);
    if (is_noticed(slot)) earliest_ = std::min(earliest_, at + delay(slot));
  }
  /// Null: nobody.
  void watch(EventWatch* watch) { watch_ = watch; }
  /// What notice_horizon(), asked before with the same flags, answers now is the earlier one of its last
  /// answer and earliest(), if nothing has happened since forget_changes() but what was set; was_put_off():
  /// it may be later.
  Cycle earliest() const { return earliest_; }
  bool was_put_off() const { return put_off_; }
  void forget_changes() {
    earliest_ = kNever;
    put_off_ = false;
  }
  /// Everything up to here has happened, and perhaps more.
  Cycle reached() const { return reached_; }

  /// Earliest instant at which the processor may notice something: a slot that acts outwards, or one cycle
  /// after a slot that may set one of these flags.
  Cycle notice_horizon(std::uint64_t irqs) {
    if (irqs != noticed_irqs_) find_noticed(irqs);
    Cycle notice = kNever;
    for (const Instant* i = queue_.data(); i->at < notice; ++i)
      if (is_noticed(i->slot)) notice = std::min(notice, i->at + delay(i->slot));
    return notice;
  }
  /// Earliest instant of a slot that may set one of these flags.
  Cycle next_for(std::uint64_t irqs) const {
    const Instant* i = queue_.data();
    while (i->at < kNever && !(slots_[static_cast<std::size_t>(i->slot)].irqs & irqs)) ++i;
    return i->at;
  }

 private:
  struct Instant {
    Cycle at = kNever;
    int slot = 0;
  };

  Cycle delay(int slot) const { return static_cast<Cycle>(~outward_ >> slot & 1); }
  bool is_noticed(int slot) const { return (noticed_ >> slot & 1) != 0; }
  void find_noticed(std::uint64_t irqs) {
    noticed_irqs_ = irqs;
    noticed_ = outward_;
    for (int s = 0; s < count_; ++s)
      if (slots_[static_cast<std::size_t>(s)].irqs & irqs) noticed_ |= std::uint64_t{1} << s;
  }
  void insert(int slot, Cycle at) {
    Instant* place = &queue_[static_cast<std::size_t>(queued_++)];
    place[1].at = kNever;
    for (; place != queue_.data() && (place[-1].at > at || (place[-1].at == at && place[-1].slot > slot));
         --place)
      place[0] = place[-1];
    *place = {at, slot};
  }
  void remove(int slot) {
    Instant* place = queue_.data();
    while (place->slot != slot) ++place;
    for (; place->at < kNever; ++place) place[0] = place[1];
    --queued_;
  }
  __attribute__((noinline)) void serve_to(Cycle now) {
    while (next() <= now) {
      const Instant first = queue_[0];
      if (watch_) watch_->about_to_change(first.at);
      remove(first.slot);
      when_[static_cast<std::size_t>(first.slot)] = kNever;
      put_off_ |= is_noticed(first.slot);
      const Slot& slot = slots_[static_cast<std::size_t>(first.slot)];
      slot.owner->on_event(slot.id, first.at);
    }
  }

  struct Slot {
    EventOwner* owner = nullptr;
    int id = 0;
    std::uint64_t irqs = 0;
  };
  std::array<Cycle, kMostSlots> when_{};
  std::array<Slot, kMostSlots> slots_{};
  int count_ = 0;
  std::array<Instant, kMostSlots + 1> queue_{};  // instants that are known, in order; then kNever
  int queued_ = 0;
  std::uint64_t outward_ = 0;  // slots that act outwards
  // of notice_horizon(), for the flags of its last call; at the beginning for none
  std::uint64_t noticed_ = 0, noticed_irqs_ = ~std::uint64_t{0};
  Cycle reached_ = 0;
  EventWatch* watch_ = nullptr;
  Cycle earliest_ = kNever;
  bool put_off_ = false;
};

}  // namespace dspic
