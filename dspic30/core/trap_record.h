// SPDX-License-Identifier: MIT
// What the core remembers of a trap, for reports.
#pragma once
#include <optional>
#include <string>

#include "dspic30/memory/cycle.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

/// What led to a trap.
struct TrapRecord {
  enum class Access { Read, Write, Fetch };
  /// What an address error is about.
  struct Touch {
    unsigned address = 0;  ///< of data; that of an instruction is one of program memory
    Access access = Access::Fetch;
    bool is_odd_word = false;  ///< which is the error, whatever lies there
  };
  Trap trap = Trap::AddressError;
  unsigned pc = 0;  ///< of the instruction; where an interrupt was entered, of the one that it cut
  Cycle at = 0;
  std::optional<Touch> touch;  ///< none: it is no address error
};

/// "0x3000 is written, where nothing is; RAM ends at 0x27ff".
std::string text_of(const TrapRecord::Touch& touch);

}  // namespace dspic
