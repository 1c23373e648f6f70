// SPDX-License-Identifier: MIT
// How much of its time a program only waits, by samples.
//
//   every kEvery cycles: go on, instruction by instruction --> back at the same one, and the state is as
//   before, but for a counter? A wait, and so the kEvery cycles count as waited
//
// A wait is a round of at most kLongestRound instructions that writes no register of a peripheral and leaves
// the processor and RAM as they were, but for one counter that is no pointer: polling, or a delay loop. A
// REPEAT of NOP is one too. What handlers do meanwhile is work of theirs, and what they change in RAM is no
// change of the round's. Every kLongEach-th look is patient: a longer round that it finds stands for the
// looks that could not find it. The samples' cycles are fixed and looking changes nothing, so the answer
// does not depend on who runs the processor how. kEvery is a prime, so that no timer keeps step with it:
// about 256 samples a second.
#pragma once
#include <array>
#include <cstdint>

#include "dspic30/core/cpu.h"

namespace dspic {

class WaitSamples {
 public:
  static constexpr Cycle kEvery = 57637;
  static constexpr int kShortRound = 64, kLongestRound = 4096, kLongEach = 16;

  /// Must the processor stop here, at the latest, and ask look()?
  Cycle next() const { return next_; }
  /// Before the instruction at cpu.next. True: one instruction only, then again.
  bool look(Cpu& cpu);
  /// A reset.
  void forget(Cpu& cpu) {
    is_looking_ = in_handler_ = cpu.watching = false;
    next_ = later_;
  }
  Cycle waited() const { return waited_; }

 private:
  void begin_look(Cpu& cpu);
  void begin_round(const Cpu& cpu);
  void enter_handler(Cpu& cpu);
  void leave_handler(Cpu& cpu);
  bool end(Cpu& cpu, bool is_wait);
  bool is_as_before(const Cpu& cpu) const;

  Cycle next_ = kEvery;  // 0: it is looking
  Cycle later_ = kEvery, waited_ = 0;
  bool is_looking_ = false, in_handler_ = false;
  int looks_ = 0, steps_ = 0, begun_ = 0;  // instructions: of this look, and before its round
  const Decoded *first_ = nullptr, *last_ = nullptr;
  unsigned lowest_sp_ = 0;
  std::uint16_t pointers_ = 0;  // registers that formed addresses in this round
  std::array<std::uint16_t, 16> w_{};
  std::array<std::uint8_t, Cpu::kRamBytes> ram_{}, ram_at_entry_{};
  Cycle watched_until_ = 0;  // when the handler began
};

}  // namespace dspic
