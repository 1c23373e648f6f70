// SPDX-License-Identifier: MIT
// Routines of the chip's runtime and library that are known by heart: what they give, and how long they take,
// as a function of their operands. The core asks at the call of such a routine; where the answer is not
// known, or something else may happen before the routine has ended, the routine itself runs. So nothing but
// the PC's time depends on it.
#pragma once
#include <cstdint>

namespace dspic {

class Cpu;

/// Of a routine of registers alone.
struct KnownAnswer {
  std::uint64_t w0_to_w3 = 0;  ///< W0 in the lowest 16 bits; registers that the routine does not return are
                               ///< as it was called with, or as it leaves them
  int cycles = 0;              ///< from its first instruction to behind RETURN; 0: not known, it runs
};
/// W0 to W3 as it is called.
using KnownFunction = KnownAnswer (*)(std::uint64_t w0_to_w3);

/// Of a routine that reads or writes RAM, or more than W0 to W3: `limit` cycles at most. Cpu::at is its
/// first instruction, Cpu::deadline - 1 - limit when that begins. Returns its cycles and has done what it
/// does; 0: it has done nothing, and the routine runs. One that settles the clocks leaves the deadline by
/// the clock of its end.
using KnownAction = int (*)(Cpu& cpu, std::int64_t limit);

/// Of an interrupt's handler, whose vector is about to be entered, at Cpu::now; clocks are settled. True: it
/// was entered and left as the core does, up to behind its RETFIE, all within run()'s `until`. False: nothing
/// was done, and it runs.
using KnownHandler = bool (*)(Cpu& cpu, int vector, std::int64_t until);

struct KnownRoutine {
  const char* name = nullptr;  ///< symbol of the image, as "___divsi3"
  std::uint64_t code = 0;  ///< code_sum() of its words (known_routines.h): another code is another routine
  KnownFunction function = nullptr;  ///< one of the two
  KnownAction action = nullptr;
  bool keeps_flags = false;  ///< its action leaves some flags as they were; others leave all of them anew
};

}  // namespace dspic
