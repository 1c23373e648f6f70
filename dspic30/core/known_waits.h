// SPDX-License-Identifier: MIT
// Waits that were proven, for when the program comes back to them from a handler.
//
// A round that only reads registers, flash and a few words of RAM at addresses of its instructions does the
// same again whenever the core's state and these words are as they were. So it need not be run to be known.
// What reads peripherals, or RAM through pointers, or stores, is no such round: skip_wait() runs it.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/memory/cycle.h"

namespace dspic {

class Cpu;
struct Decoded;

/// All that a round may change and that is neither RAM nor a peripheral's, in words that compare quickly.
struct CoreState {
  CoreState() = default;
  explicit CoreState(const Cpu& cpu);
  bool operator==(const CoreState& other) const {
    // one by one: what has just been stored in halves would be waited for if it were loaded as a whole
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] != other.words[i]) return false;
    return true;
  }
  bool operator!=(const CoreState& other) const { return !(*this == other); }
  std::array<std::uint64_t, 10> words{};
};

class KnownWaits {
 public:
  /// Cycles of a round, if the program goes round from cpu.next on, reading nothing that can change without
  /// an interrupt; 0: not known. `now`: CoreState(cpu).
  Cycle round(const Cpu& cpu, const CoreState& now) const;
  /// The instructions of a round, in their order.
  struct Course {
    static constexpr std::size_t kLongest = 40;
    std::array<const Decoded*, kLongest> at;
    std::size_t count = 0;
  };
  /// A round from cpu.next on has been proven to change nothing. `took`: cycles.
  void add(const Cpu& cpu, const Course& course, Cycle took, const CoreState& now);
  void forget() { waits_ = {}; }

 private:
  static constexpr std::size_t kMostWords = 6;
  struct Wait {
    const Decoded* first = nullptr;
    Cycle took = 0;
    std::size_t words = 0;
    std::array<std::uint16_t, kMostWords> index{}, value{};  // in RAM, bytes from its start; what was read
    std::uint16_t corcon = 0;
    CoreState state;
    bool read(const Cpu& cpu, const Decoded* instruction);
  };
  static std::size_t place_of(const Decoded* first);

  // by the instruction that a round is met at: an interrupt comes to any of them
  std::array<Wait, 16> waits_{};
};

}  // namespace dspic
