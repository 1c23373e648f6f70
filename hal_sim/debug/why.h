// SPDX-License-Identifier: MIT
// What a standing program waits for: the loop that it goes round in, what it reads there, who could change
// that, and which interrupts are pending but held off. Read from the code and the chip's registers; nothing
// runs. Writes through pointers are not seen.
#pragma once
#include <string>

#include "hal_sim/debug/session.h"

namespace debug {

/// Lines for people.
std::string why(Session& session);
/// Enabled or pending interrupts and traps with their priorities, a line each.
std::string interrupts(Session& session);

}  // namespace debug
