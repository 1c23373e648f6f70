// SPDX-License-Identifier: MIT
// What the core remembers of a trap, for reports.
#pragma once
#include "dspic30/memory/cycle.h"
#include "dspic30/periph/vectors.h"

namespace dspic {

/// What led to a trap.
struct TrapRecord {
  Trap trap = Trap::AddressError;
  unsigned pc = 0;  ///< of the instruction; where an interrupt was entered, of the one that it cut
  Cycle at = 0;
};

}  // namespace dspic
