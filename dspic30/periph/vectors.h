// SPDX-License-Identifier: MIT
// Numbers and names of the chip's interrupt and trap vectors, and its kinds of reset. [chip C11]
#pragma once
#include <cstdint>

#include "dspic30/memory/cycle.h"
#include "dspic30/memory/irqs.h"

namespace dspic {

/// Interrupt and trap vectors in natural order: 1 to 4 traps, 8 + IRQ the sources (T1 is IRQ 3, vector 11).
inline constexpr int kNoVector = -1;
inline constexpr int kFirstIrqVector = 8;
inline constexpr int kVectors = kFirstIrqVector + kIrqs;

/// "T1", "U1RX", "ADC", "MathError" ... as in _T1Interrupt and _MathError; "?" for reserved ones.
const char* vector_name(int vector);

/// Cycles between the last instruction before a handler and the handler's first one, and of RETFIE. From the
/// cycle in which a flag is set to the handler's first instruction: one more. [chip C11],
/// doubt 1 there
inline constexpr Cycle kInterruptEntryCycles = 3;
inline constexpr Cycle kInterruptReturnCycles = 3;

enum class ResetKind : std::uint8_t {
  PowerOn,
  BrownOut,
  Pin,          ///< MCLR
  Instruction,  ///< RESET
  Watchdog,
  IllegalOpcode,  ///< or an uninitialised W register used as an address
  TrapConflict,
};

enum class Trap : std::uint8_t { OscillatorFailure = 1, AddressError, StackError, MathError };

struct InterruptEntry {
  int vector = kNoVector;
  int level = 0;                ///< CPU level from now on: 1 to 7, traps 11 to 14
  unsigned address = 0;         ///< of the vector's word in program memory (AIVT when INTCON2.ALTIVT = 1)
  Cycle first_instruction = 0;  ///< cycle in which the handler's first instruction executes
};

}  // namespace dspic
