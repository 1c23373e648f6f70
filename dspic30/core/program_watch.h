// SPDX-License-Identifier: MIT
// What a program does that is hardly ever meant, and functions of it that somebody wants to know of: told to
// whoever looks after it, at the instruction itself. Nobody pays for it where it does not happen.
#pragma once
#include "dspic30/core/trap_record.h"

namespace dspic {

class ProgramWatch {
 public:
  virtual ~ProgramWatch() = default;
  /// An instruction led to a trap.
  virtual void trapped(const TrapRecord& trap) = 0;
  /// A call, jump or return at `from` leads to address 0: the program begins anew, and nothing is reset.
  virtual void went_to_reset_vector(unsigned from) = 0;
  /// The function at `address`, which was asked for (Processor::tell_calls), begins; its arguments are in W0
  /// and behind, the return address lies on the stack.
  virtual void entered(unsigned address) = 0;
};

}  // namespace dspic
