// SPDX-License-Identifier: MIT
// Loops that do nothing but count: waits with an end.
//
//   a round as it was run --prove()--> Count: which word counts, by how much, what moves with it
//   Count, state of the core --rounds_from()--> so many rounds will be like that one
//
// All that a round does to what moves are copies, sums and differences of words, so each moving value is a
// constant and a multiple of the counter for as long as the carries stay. N, C and OV follow from the top
// bits of the two operands, of which one moves, and of the result; Z from whether the result is 0. So while
// no moving value leaves its half of the 16 bits, and no result comes to 0, all flags stay as they are round
// by round, and with them the way and the time of a round.
//
// One word counts: W register, word of RAM, or the count of a DO loop; it forms no address. What is read
// of it may pass through other words, which are then written before they are read. All else that the
// round looks at stays.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "dspic30/core/decoded.h"
#include "dspic30/core/known_waits.h"

namespace dspic {

/// One instruction of a round.
struct CountStep {
  const Decoded* at = nullptr;
  std::uint16_t result = 0;      ///< as N saw it
  RoundMemory::Touched touched;  ///< words of RAM, in order
};

class Count {
 public:
  /// Is `round`, run from its state to where `cpu` is now, a round of a loop that counts?
  bool prove(const Cpu& cpu, const KnownWaits::Wait& round, const std::vector<CountStep>& steps);
  const KnownWaits::Wait& round() const { return round_; }
  /// Rounds from here on, at the first instruction, that are like the one that was proven; -1: what it looks
  /// at is another.
  Cycle rounds_from(const Cpu& cpu) const;
  /// Is it over for whatever else it looks at than its counter: does a word of RAM differ?
  bool is_over(const Cpu& cpu) const;
  /// Is all as it was but for W registers and flags: RAM, the pages of constants, the stack's limit?
  bool is_as_proven(const Cpu& cpu) const { return is_core_as_proven(cpu) && !is_over(cpu); }
  /// `rounds` later, but for what the next round writes before it looks at it.
  void advance(Cpu& cpu, Cycle rounds) const;
  /// Does the round look at flags that it has not set?
  bool reads_flags() const { return reads_flags_; }
  /// Does the round depend on no more than this holds?
  bool is_plain(const Cpu& cpu) const;
  /// As KnownWaits::move(), from the words that began at `from`.
  void move(const Decoded* from, const Decoded* to) { round_.first = to + (round_.first - from); }

 private:
  friend class KnownCounts;
  friend class CountProof;
  struct Moving {
    std::uint16_t value = 0, times = 0;  // in the proven round; per step of the counter
    bool is_result = false;
  };
  static constexpr std::size_t kMostMoving = 24;
  // places: W registers, the DO loop's count, then RAM
  static constexpr int kLoopCount = 16, kRam = 32;

  std::uint16_t counter_now(const Cpu& cpu) const;
  bool is_core_as_proven(const Cpu& cpu) const;

  KnownWaits::Wait round_;
  int counter_ = 0;
  std::uint16_t value_ = 0, step_ = 0;  // of the counter as the round began; per round
  std::uint16_t registers_ = 0;         // that it looks at, but for the counter
  bool reads_flags_ = false;            // before it sets them
  std::uint8_t flags_ = 0;
  std::array<Moving, kMostMoving> moving_{};
  std::size_t moving_count_ = 0;
};

/// Those that were proven, by their first instruction: at its place, or at one of the next.
class KnownCounts {
 public:
  /// null: none is known there.
  const Count* at(const Decoded* first) const {
    for (std::size_t i = 0; i < kTried; ++i)
      if (const auto& count = counts_[(place_of(first) + i) % kMost]; count && count->round_.first == first)
        return count.get();
    return nullptr;
  }
  const Count& add(const Count& count) {
    const Decoded* const first = count.round_.first;
    std::size_t at = place_of(first);
    for (std::size_t i = kTried; i-- > 0;)
      if (const auto& known = counts_[(place_of(first) + i) % kMost];
          !known || !known->round_.first || known->round_.first == first)
        at = (place_of(first) + i) % kMost;
    auto& place = counts_[at];
    if (!place) place = std::make_unique<Count>();
    return *place = count;
  }
  void forget() {
    for (const auto& count : counts_)
      if (count) count->round_.first = nullptr;
  }
  /// As KnownWaits::move().
  void move(const Decoded* code) {
    for (const auto& count : counts_)
      if (count && count->round_.first) count->move(code_, code);
    code_ = code;
  }

 private:
  std::size_t place_of(const Decoded* first) const { return words_between(code_, first) % kMost; }
  static constexpr std::size_t kMost = 32, kTried = 4;  // places
  std::array<std::unique_ptr<Count>, kMost> counts_;
  const Decoded* code_ = nullptr;
};

}  // namespace dspic
