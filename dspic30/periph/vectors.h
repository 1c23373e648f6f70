// SPDX-License-Identifier: MIT
// Numbers and names of the chip's interrupt and trap vectors, and its kinds of reset. [chip C11]
#pragma once
#include <cstdint>

#include "dspic30/memory/cycle.h"

namespace dspic {

/// Interrupt and trap vectors in natural order: 1 to 4 traps, 8 + IRQ the sources (T1 is IRQ 3, vector 11).
inline constexpr int kNoVector = -1;
inline constexpr int kFirstIrqVector = 8;
inline constexpr int kIrqs = 54;
inline constexpr int kVectors = kFirstIrqVector + kIrqs;

/// Interrupt sources by their bit in IFS0..IFS3.
namespace irq {
enum : int {
  Int0,
  Ic1,
  Oc1,
  T1,
  Ic2,
  Oc2,
  T2,
  T3,
  Spi1,
  U1Rx,
  U1Tx,
  Adc,
  Nvm,
  SlaveI2c,
  MasterI2c,
  Cn,
  Int1,
  Ic7,
  Ic8,
  Oc3,
  Oc4,
  T4,
  T5,
  Int2,
  U2Rx,
  U2Tx,
  Spi2,
  C1,
  Ic3,
  Ic4,
  Ic5,
  Ic6,
  Oc5,
  Oc6,
  Oc7,
  Oc8,
  Int3,
  Int4,
  C2,
  Dci = 41,
  Lvd = 42,
};
}  // namespace irq

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
