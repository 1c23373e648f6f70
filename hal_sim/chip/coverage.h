// SPDX-License-Identifier: MIT
// From counts of a program's instructions to counts of its source: lines, branches, functions.
//
//   StepCounts + the image's DWARF --coverage_of--> Lcov
//
// A line ran as often as the busiest of the pieces of code that begin in it, once for each function in which
// it stands: `for (i = 0; i < 10; i++)` 11 times. A branch is a conditional branch or skip, with how often
// the program went on and how often it jumped. Functions that the linker left out have the count 0; lines
// without code none.
#pragma once
#include <functional>
#include <string>

#include "dspic30/load/firmware_file.h"
#include "hal_sim/chip/lcov.h"
#include "hal_sim/chip/step_counts.h"

namespace chip {

/// `is_own`: does a source, by its whole path, count? `counts`: null: nothing ran yet.
Lcov coverage_of(const dspic::FirmwareFile& file, const StepCounts* counts,
                 const std::function<bool(const std::string&)>& is_own);

}  // namespace chip
