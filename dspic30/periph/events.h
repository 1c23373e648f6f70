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

/// Hears of every instant before anything happens in it, and before each access of the program: whoever draws
/// registers over time.
class EventWatch {
 public:
  virtual ~EventWatch() = default;
  /// The chip changes by itself in cycle `at`; all that changed before is in place. May peek, not change.
  virtual void about_to_change(Cycle at) = 0;
  /// The program reads in cycle `at`, and what is worked out when somebody looks is worked out up to there.
  virtual void about_to_be_read(Cycle /*at*/) {}
};

class Events {
 public:
  static constexpr int kMostSlots = 42;

  /// `irqs`: bit i if the event may set the flag of IRQ i; `outward`: it may move a pin or ask for a reset;
  /// `sends`: whoever is outside hears of it.
  int add(EventOwner& owner, int id, std::uint64_t irqs, bool outward, bool sends = false) {
    slots_[static_cast<std::size_t>(count_)] = {&owner, irqs};
    ids_[static_cast<std::size_t>(count_)] = static_cast<std::uint8_t>(id);
    outward_ |= static_cast<std::uint64_t>(outward) << count_;
    sends_ |= static_cast<std::uint64_t>(sends) << count_;
    when_[static_cast<std::size_t>(count_)] = kNever;
    return count_++;
  }

  void set(int slot, Cycle at) {
    at = std::min(at, kNever);
    const Cycle before = when(slot);
    if (before == at) return;
    if (before < kNever) remove(slot);
    when_[static_cast<std::size_t>(slot)] = at;
    if (at < kNever) insert(slot, at);
  }
  Cycle when(int slot) const { return when_[static_cast<std::size_t>(slot)]; }
  Cycle next() const { return next_; }

  void run_to(Cycle now) {
    if (next() <= now) serve_to(now);
  }
  /// run_to() where something is due nearly always.
  __attribute__((always_inline)) void run_due(Cycle now) {
    while (next() <= now) serve_first();
  }
  /// set() of a slot that is empty, as in its own on_event(), to an instant that comes.
  void fill(int slot, Cycle at) {
    when_[static_cast<std::size_t>(slot)] = at;
    insert(slot, at);
  }
  /// Null: nobody.
  void watch(EventWatch* watch) { watch_ = watch; }
  bool is_watched() const { return watch_ != nullptr; }
  /// The program, or who plays a part of it, is about to change something.
  void tell_change(Cycle at) const {
    if (watch_) watch_->about_to_change(at);
  }
  void tell_read(Cycle at) const {
    if (watch_) watch_->about_to_be_read(at);
  }
  /// Earliest instant at which the processor may notice something: a slot that acts outwards, or one cycle
  /// after a slot that sends, or may set one of these flags.
  Cycle notice_horizon(std::uint64_t irqs) {
    if (irqs != noticed_irqs_) find_noticed(irqs);
    Cycle horizon = kNever;
    for (const Known* i = soonest(); instant_of(*i) < horizon; --i)
      if (const std::size_t slot = slot_of(*i); noticed_ >> slot & 1)
        horizon = std::min(horizon, instant_of(*i) + delay(slot));
    return horizon;
  }
  /// Earliest instant of a slot that may set one of these flags.
  Cycle next_for(std::uint64_t irqs) const {
    const Known* i = soonest();
    while (*i < kNone && !(slots_[slot_of(*i)].irqs & irqs)) --i;
    return instant_of(*i);
  }

 private:
  // an instant and its slot in one number, ordered as they are served
  using Known = std::int64_t;
  static constexpr int kSlotBits = 6;
  static constexpr Known kNone = kNever << kSlotBits;
  static_assert(1 << kSlotBits >= kMostSlots);
  static std::size_t slot_of(Known known) { return static_cast<std::size_t>(known & ((1 << kSlotBits) - 1)); }
  static Cycle instant_of(Known known) { return known >> kSlotBits; }

  Cycle delay(std::size_t slot) const { return static_cast<Cycle>(~outward_ >> slot & 1); }
  __attribute__((noinline)) void find_noticed(std::uint64_t irqs) {
    noticed_irqs_ = irqs;
    noticed_ = outward_ | sends_;
    for (int s = 0; s < count_; ++s)
      if (slots_[static_cast<std::size_t>(s)].irqs & irqs) noticed_ |= std::uint64_t{1} << s;
  }
  void insert(int slot, Cycle at) {
    const Known known = at << kSlotBits | slot;
    Known* place = &queue_[++queued_];
    for (; place[-1] < known; --place) place[0] = place[-1];
    *place = known;
    next_ = std::min(next_, at);
  }
  void remove(int slot) {
    const Known* const last = soonest();
    Known* place = &queue_[queued_];
    while (slot_of(*place) != static_cast<std::size_t>(slot)) --place;
    for (; place != last; ++place) place[0] = place[1];
    --queued_;
    next_ = instant_of(*soonest());
  }
  const Known* soonest() const { return &queue_[queued_]; }
  __attribute__((always_inline)) void serve_first() {
    const Cycle at = next_;
    const std::size_t first = slot_of(*soonest());
    if (watch_) watch_->about_to_change(at);
    --queued_;
    next_ = instant_of(*soonest());
    when_[first] = kNever;
    slots_[first].owner->on_event(ids_[first], at);
  }
  __attribute__((noinline)) void serve_to(Cycle now) { run_due(now); }

  struct Slot {
    EventOwner* owner = nullptr;
    std::uint64_t irqs = 0;
  };
  // what every turn of the processor looks at, together
  Cycle next_ = kNever;  // the last one's in queue_
  EventWatch* watch_ = nullptr;
  // slots that notice_horizon() looks for, and for which flags; at the beginning for none
  std::uint64_t noticed_ = 0, noticed_irqs_ = ~std::uint64_t{0};
  std::uint64_t outward_ = 0, sends_ = 0;  // slots that act outwards, that send
  std::size_t queued_ = 0;
  std::array<Known, kMostSlots + 1> queue_{kNone};  // and what is known, the soonest last
  int count_ = 0;
  std::array<Cycle, kMostSlots> when_{};
  std::array<Slot, kMostSlots> slots_{};
  std::array<std::uint8_t, kMostSlots> ids_{};
};

}  // namespace dspic
