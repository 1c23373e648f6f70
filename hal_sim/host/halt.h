// SPDX-License-Identifier: MIT
// The last look at a process that does not come back from a tick: what its threads were at.
#pragma once
#include <string>

namespace host {

/// Stops every thread that has run firmware or supervisors, for good, and says what each was at: "robot
/// 'puck' was running: main (main.c:9)". Empty: neither was. For whoever ends the process next; called by a
/// thread that is none of them.
std::string halt_threads();

}  // namespace host
