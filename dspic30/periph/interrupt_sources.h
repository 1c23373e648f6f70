// SPDX-License-Identifier: MIT
// The sources of interrupts: flags (IFS), enables (IEC) and priorities (IPC), a bit each in one word, and when
// each flag was set last. Source: [chip C11].
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "dspic30/memory/cycle.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

class InterruptSources {
 public:
  bool flag(int irq) const { return (ifs_ >> irq & 1) != 0; }
  bool enabled(int irq) const { return (iec_ >> irq & 1) != 0; }
  std::uint64_t flags() const { return ifs_; }
  std::uint64_t enabled_mask() const { return iec_; }
  /// Flags that are set and enabled; of these, those whose priority is not 0.
  std::uint64_t ready() const { return ifs_ & iec_; }
  std::uint64_t waking() const { return ready() & ~at_priority_[0]; }
  int priority(int irq) const { return priority_[static_cast<std::size_t>(irq)]; }
  /// Sources of that priority, a bit each.
  std::uint64_t at_priority(int priority) const { return at_priority_[static_cast<std::size_t>(priority)]; }
  Cycle since(int irq) const { return since_[static_cast<std::size_t>(irq)]; }
  /// Latest of since().
  Cycle newest() const { return newest_; }
  /// Of these flags, those that were set after `at`.
  std::uint64_t younger_than(Cycle at, std::uint64_t flags) const {
    std::uint64_t younger = 0;
    for (; flags; flags &= flags - 1) {
      const int i = __builtin_ctzll(flags);
      if (since_[static_cast<std::size_t>(i)] > at) younger |= std::uint64_t{1} << i;
    }
    return younger;
  }
  /// When an enabled flag wakes the processor, whatever its priority: a cycle after it was set; kNever: none is
  /// set. `at_work`: the sources that set flags meanwhile; of the others one does that was set up to `asleep`.
  Cycle wakes_at(std::uint64_t at_work, Cycle asleep) const {
    Cycle at = kNever;
    for (std::uint64_t ready = waking(); ready; ready &= ready - 1) {
      const int i = __builtin_ctzll(ready);
      if (const Cycle since = since_[static_cast<std::size_t>(i)]; (at_work >> i & 1) || since <= asleep)
        at = std::min(at, since + 1);
    }
    return at;
  }

  // --- for the controller
  void set(int irq, Cycle at) {
    ifs_ |= std::uint64_t{1} << irq;
    note_set(irq, at);
  }
  void note_set(int irq, Cycle at) {
    since_[static_cast<std::size_t>(irq)] = at;
    newest_ = std::max(newest_, at);
  }
  void set_flags(std::uint64_t flags) { ifs_ = flags; }
  void enable(std::uint64_t mask) { iec_ = mask; }
  void set_priority(int irq, int priority) {
    auto& now = priority_[static_cast<std::size_t>(irq)];
    at_priority_[now] &= ~(std::uint64_t{1} << irq);
    now = static_cast<std::uint8_t>(priority);
    at_priority_[now] |= std::uint64_t{1} << irq;
  }
  void reset(int priority, Cycle now) {
    *this = InterruptSources{};
    for (int i = 0; i < kIrqs; ++i) set_priority(i, priority);
    since_.fill(now);
  }

 private:
  std::uint64_t ifs_ = 0, iec_ = 0;
  Cycle newest_ = -1;
  std::array<std::uint64_t, 8> at_priority_{};  // bit i: IRQ i has this priority
  std::array<std::uint8_t, kIrqs> priority_{};
  std::array<Cycle, kIrqs> since_{};
};

/// A source that counts for itself while its flag is set hears when software clears it.
class FlagListener {
 public:
  virtual ~FlagListener() = default;
  virtual void flag_cleared(int irq, Cycle now) = 0;
  /// INTCON2.INTxEP of this source was changed.
  virtual void edge_chosen(int /*irq*/, Cycle /*now*/) {}
};

class FlagListeners {
 public:
  void listen(int irq, FlagListener& listener) {
    if (count_ == kMost) std::abort();
    listeners_[++count_] = &listener;
    numbers_[static_cast<std::size_t>(irq)] = static_cast<std::uint8_t>(count_);
    hear(irq, true);
  }
  /// Does it want to hear of it now? From listen() on it does.
  void hear(int irq, bool wants) {
    const std::uint64_t bit = std::uint64_t{1} << irq;
    heard_ = wants ? heard_ | bit : heard_ & ~bit;
  }
  /// Bit i: IRQ i has a listener that wants to hear.
  std::uint64_t heard() const { return heard_; }
  /// Null: it has none.
  FlagListener* of(int irq) const { return listeners_[numbers_[static_cast<std::size_t>(irq)]]; }

 private:
  static constexpr std::size_t kMost = 12;  // five timers, five pins
  std::uint64_t heard_ = 0;
  std::size_t count_ = 0;
  std::array<std::uint8_t, kIrqs> numbers_{};  // in listeners_, whose first is none
  std::array<FlagListener*, kMost + 1> listeners_{};
};

/// How often something happened to each of a few numbers of many, which begin to count when it does.
class Tally {
 public:
  std::int64_t of(int number) const {
    for (const Row& row : rows_)
      if (row.number == number) return row.count;
    return 0;
  }
  /// Returns how often before.
  std::int64_t add(int number, std::int64_t times = 1) {
    for (Row& row : rows_)
      if (row.number == number) return std::exchange(row.count, row.count + times);
    rows_.push_back({number, times});
    return 0;
  }

 private:
  struct Row {
    int number = 0;
    std::int64_t count = 0;
  };
  std::vector<Row> rows_;
};

/// Sources that come in a rhythm while their flag stays set: how many of their events are missed is known
/// without telling each.
class Rhythms {
 public:
  /// One was missed at `since`, another is each `period`.
  void begin(int irq, Cycle since, Cycle period) {
    for (Row& row : rows_)
      if (row.irq < 0) {
        row = {irq, since, period};
        return;
      }
  }
  /// Those behind the first, by `now`.
  std::int64_t of(int irq, Cycle now) const {
    for (const Row& row : rows_)
      if (row.irq == irq) return (now - row.since) / row.period;
    return 0;
  }
  /// The same, and no more are missed.
  std::int64_t end(int irq, Cycle now) {
    const std::int64_t all = of(irq, now);
    for (Row& row : rows_)
      if (row.irq == irq) row = {};
    return all;
  }

 private:
  struct Row {
    int irq = -1;  // none
    Cycle since = 0, period = 1;
  };
  std::array<Row, 2> rows_;  // as many as there are handlers known by heart
};

/// Events that found their enabled flag still set, by source, and handlers that began, by vector, since
/// power-up.
struct InterruptTally {
  Tally missed, served;
  Rhythms missing;             ///< not among `missed` yet
  std::uint64_t standing = 0;  ///< sources without a clock in Sleep, a bit each: they have no events
};

}  // namespace dspic
