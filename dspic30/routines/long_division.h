// SPDX-License-Identifier: MIT
// Division of 32 bits, for the routines that call it.
#pragma once
#include <cstdint>

#include "dspic30/core/cpu.h"

namespace dspic::long_division {

struct Division {
  std::uint32_t dividend = 0, divisor = 0, quotient = 0, remainder = 0;
  int cycles = 0;  ///< of __divide_long; 0: divided by 0
};
Division divide(std::uint32_t dividend, std::uint32_t divisor);

/// Registers as __divide_long leaves them: quotient, remainder, what it has worked with; and flags.
void leave_division(Cpu& cpu, const Division& d);

}  // namespace dspic::long_division
