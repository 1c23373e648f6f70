// SPDX-License-Identifier: MIT
// What is told of a program that waits for ever: what it waits for, and who writes that, by the text of its
// sources. Names are looked for as words; what happens by pointers is not seen.
#pragma once
#include <string>
#include <vector>

#include "hal_sim/host/runner.h"

namespace host {

/// Global and static variables of the program in a line of its source.
std::vector<std::string> variables_in(const Runner& program, const Place& place);
/// Nothing that the loop at `place` looks at can change, since `since`, for no interrupt is enabled.
board::Diagnosis endless_wait(const Runner& program, const Place& place, Cycle since);

}  // namespace host
