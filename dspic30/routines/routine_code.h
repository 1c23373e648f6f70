// SPDX-License-Identifier: MIT
// The code of a routine as one number: all that is reached from its first word, through branches, GOTOs and
// calls, wherever the linker has put the parts. Two routines with the same sum do the same in the same time.
#pragma once
#include <cstdint>

#include "dspic30/memory/program_memory.h"

namespace dspic {

/// 0: it cannot be followed (a computed branch, a DO loop, an interrupt's return), or is longer than any
/// known routine. `hides_variable`: the first address of RAM that it loads stands for a variable, whose place
/// is the linker's affair too.
std::uint64_t code_sum(const ProgramMemory& program, unsigned address, bool hides_variable = false);

}  // namespace dspic
