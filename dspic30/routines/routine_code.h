// SPDX-License-Identifier: MIT
// The code of a routine as one number: all that is reached from its first word, through branches, GOTOs and
// calls, wherever the linker has put the parts. Two routines with the same sum do the same in the same time.
#pragma once
#include <cstdint>

#include "dspic30/memory/program_memory.h"

namespace dspic {

/// 0: it cannot be followed (a computed branch, a DO loop, an interrupt's return), or is longer than any
/// known routine.
std::uint64_t code_sum(const ProgramMemory& program, unsigned address);

}  // namespace dspic
