// SPDX-License-Identifier: MIT
// What the core remembers of a trap, for reports.
#pragma once
#include "dspic30/memory/cycle.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

/// What led to a trap.
struct TrapRecord {
  Trap trap = Trap::AddressError;
  unsigned pc = 0;             ///< of the instruction; where an interrupt was entered, of the one that it cut
  unsigned stack_pointer = 0;  ///< W15 as the instruction had left it by then
  unsigned stack_limit = 0;    ///< SPLIM; 0: not set
  Cycle at = 0;
};

}  // namespace dspic
