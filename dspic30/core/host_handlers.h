// SPDX-License-Identifier: MIT
// Handlers known by heart, as the core runs them: entered as an interrupt is, with their registers on the
// stack, they call functions of the program, and return as RETFIE does (host_calls.h).
#pragma once
#include "dspic30/core/cpu.h"

namespace dspic {

/// A handler known by heart is entered, as an interrupt is; go_on_with_handler() is next.
void enter_handler(Cpu& cpu);
/// What the handler does next, behind its entry or a return to it. The clock is where that begins.
const Decoded* go_on_with_handler(Cpu& cpu, const Decoded* from);
/// RETFIE's work: level, flags and place of the program from the stack. `rest`: cycles of it that are not
/// counted yet.
const Decoded* return_from_handler(Cpu& cpu, const Decoded* from, Cycle rest);
/// Does the program wait in a function of the host?
bool stands_in_host(const Cpu& cpu);

}  // namespace dspic
