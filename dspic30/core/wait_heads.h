// SPDX-License-Identifier: MIT
// Where waits of one robot's program begin, and whether it stops there to look. A look that finds none makes
// the next one rarer, for this head alone.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dspic30/core/decoded.h"
#include "dspic30/memory/cycle.h"

namespace dspic {

class WaitHeads {
 public:
  bool has(const Decoded* d) const { return (some_ >> ((d - code_) & 63) & 1) != 0 && find(d); }
  /// From now on one is here.
  void add(const Decoded* d);
  void forget() {
    heads_.clear();
    some_ = 0;
  }
  /// The program goes on in other words, alike and in the same order; `code` is the first. `mark` is called for
  /// each head there.
  template <class Mark>
  void move(const Decoded* code, Mark&& mark) {
    code_ = code;
    for (const Head& head : heads_)
      if (head.place >= 0) mark(code_ + head.place);
  }
  /// Does the program stop at this head, at that true time?
  bool would_stop(const Decoded* d, Cycle when) const {
    const Head* const head = find(d);
    return head && !passes && !is_met && when >= head->from;
  }
  /// The program comes to it at that true time. False: it does not stop. What `passes` says is over.
  bool is_due(const Decoded* d, Cycle when) const {
    const Head* const head = find(d);
    return head && when >= head->from;
  }
  /// The program has stopped at one; `deadline` was its deadline.
  void meet(Cycle deadline) {
    is_met = true;
    kept_deadline = deadline;
  }
  /// A look from there at `now`, true time, found a wait, or none: then the program does not stop there for a
  /// while, each time for longer.
  void pause(const Decoded* d, bool is_wait, Cycle now);
  /// Up to that true time the program does not stop there.
  void hold(const Decoded* d, Cycle until) {
    if (Head* const head = find(d)) head->from = std::max(head->from, until);
  }
  /// A wait of that head has ended: how often before?
  unsigned count_end(const Decoded* d) {
    Head* const head = find(d);
    return head ? head->ends++ : 0;
  }

  bool is_met = false;  ///< the program has stopped at one; kept_deadline was its deadline
  bool passes = false;  ///< the one where it stands is passed
  Cycle kept_deadline = 0;

 private:
  static constexpr std::int32_t kFirstPause = 50;
  struct Head {
    Cycle from = 0;                    // true time from which on the program stops there
    std::int32_t place = -1;           // word of flash
    std::int32_t pause = kFirstPause;  // cycles
    unsigned ends = 0;                 // of its wait
  };
  // most programs have fewer than the fewest; behind the most one takes another's place
  static constexpr std::size_t kFewest = 8, kMost = 32;
  static constexpr std::ptrdiff_t kTried = 4;
  /// One is at its place, or at one of the next.
  Head& slot(std::ptrdiff_t place) { return heads_[static_cast<std::size_t>(place) & (heads_.size() - 1)]; }
  Head* free_slot(std::ptrdiff_t place);
  void put(const Head& head);
  void widen();
  Head* find(const Decoded* d) { return const_cast<Head*>(static_cast<const WaitHeads*>(this)->find(d)); }
  const Head* find(const Decoded* d) const {
    if (heads_.empty()) return nullptr;
    const std::ptrdiff_t place = d - code_;
    for (std::ptrdiff_t i = 0; i < kTried; ++i)
      if (const Head& head = heads_[static_cast<std::size_t>(place + i) & (heads_.size() - 1)];
          head.place == place)
        return &head;
    return nullptr;
  }

  const Decoded* code_ = nullptr;
  std::uint64_t some_ = 0;   // a bit for each place with a head, by its lowest bits: others need no search
  std::vector<Head> heads_;  // a power of two, or none
};

}  // namespace dspic
