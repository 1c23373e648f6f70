// SPDX-License-Identifier: MIT
// How much of its time a program only waits, by samples.
//
//   every kEvery cycles: run one round, instruction by instruction --> state as before, but for a counter?
//   a wait, and so the kEvery cycles count as waited
//
// A wait is a round of at most kLongestRound instructions that writes no register of a peripheral and leaves
// the processor and RAM as they were, but for one counter that is no pointer: polling, or a delay loop. A
// REPEAT of NOP is one too. A round that an interrupt cuts is looked at again. What a handler does is work.
// The samples' cycles are fixed and looking changes nothing, so the answer does not depend on who runs the
// processor how. kEvery is a prime, so that no timer keeps step with it: about 256 samples a second.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/core/cpu.h"

namespace dspic {

class WaitSamples {
 public:
  static constexpr Cycle kEvery = 57637;
  static constexpr int kLongestRound = 64, kMostRounds = 4;

  /// Must the processor stop here, at the latest, and ask look()?
  Cycle next() const { return next_; }
  /// Before the instruction at cpu.next. True: one instruction only, then again.
  bool look(Cpu& cpu);
  /// A reset.
  void forget() {
    is_looking_ = false;
    next_ = later_;
  }
  Cycle waited() const { return waited_; }

 private:
  bool begin_round(Cpu& cpu);
  bool end(Cpu& cpu, bool is_wait);
  bool is_as_before(const Cpu& cpu) const;

  Cycle next_ = kEvery;  // 0: it is looking
  Cycle later_ = kEvery, waited_ = 0;
  bool is_looking_ = false, was_cut_ = false;
  int rounds_ = 0, steps_ = 0;
  const Decoded* first_ = nullptr;
  std::uint16_t pointers_ = 0;  // registers that formed addresses in this round
  std::array<std::uint16_t, 16> w_{};
  std::array<std::uint8_t, Cpu::kRamBytes> ram_{};
};

}  // namespace dspic
