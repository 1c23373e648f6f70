// SPDX-License-Identifier: MIT
// The instants at which peripherals do something by themselves: one slot each, served in order of time, equal
// times in order of the slots. What happens between two instants is a closed form of its owner.
#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "dspic30/memory/cycle.h"

namespace dspic {

class EventOwner {
 public:
  virtual ~EventOwner() = default;
  /// The slot's instant `at` has come; the slot is empty now and may be set again, to `at` or later.
  virtual void on_event(int id, Cycle at) = 0;
};

class Events {
 public:
  /// `irqs`: bit i if the event may set the flag of IRQ i; `outward`: it may move a pin or ask for a reset.
  int add(EventOwner& owner, int id, std::uint64_t irqs, bool outward) {
    when_.push_back(kNever);
    slots_.push_back({&owner, id, irqs, outward});
    return static_cast<int>(when_.size()) - 1;
  }

  void set(int slot, Cycle at) {
    const auto s = static_cast<std::size_t>(slot);
    if (when_[s] == at) return;
    when_[s] = at;
    const std::uint64_t bit = std::uint64_t{1} << s;
    if (at >= kNever)
      active_ &= ~bit;
    else
      active_ |= bit;
    refresh();
  }
  Cycle when(int slot) const { return when_[static_cast<std::size_t>(slot)]; }
  Cycle next() const { return next_; }

  void run_to(Cycle now) {
    while (next_ <= now) {
      std::uint64_t left = active_;
      while (when_[static_cast<std::size_t>(__builtin_ctzll(left))] != next_) left &= left - 1;
      const auto first = static_cast<std::size_t>(__builtin_ctzll(left));
      const Cycle at = next_;
      when_[first] = kNever;
      active_ &= ~(std::uint64_t{1} << first);
      refresh();
      slots_[first].owner->on_event(slots_[first].id, at);
    }
  }

  /// Earliest instant of a slot that may set one of these flags, or that acts outwards.
  Cycle next_for(std::uint64_t irqs, bool outward) const {
    Cycle next = kNever;
    for (std::uint64_t left = active_; left; left &= left - 1) {
      const auto s = static_cast<std::size_t>(__builtin_ctzll(left));
      if (when_[s] < next && ((slots_[s].irqs & irqs) || (outward && slots_[s].outward))) next = when_[s];
    }
    return next;
  }

 private:
  void refresh() {
    next_ = kNever;
    for (std::uint64_t left = active_; left; left &= left - 1)
      next_ = std::min(next_, when_[static_cast<std::size_t>(__builtin_ctzll(left))]);
  }
  struct Slot {
    EventOwner* owner;
    int id;
    std::uint64_t irqs;
    bool outward;
  };
  std::vector<Cycle> when_;
  std::vector<Slot> slots_;   // at most 64
  std::uint64_t active_ = 0;  // bit s: slot s has an instant
  Cycle next_ = kNever;
};

}  // namespace dspic
