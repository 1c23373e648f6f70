// SPDX-License-Identifier: MIT
// Debugging information. Objects count code in octets, four a word; the chip counts two addresses a word.
// Absolute addresses are made right where they are filled in; distances are made right here.
#pragma once
#include "dspic30/link/link.h"

namespace dspic::link {

/// Sections of the same name follow one another: sets where each begins.
void place_debug(Program& program);
/// Line tables, call frames and location lists in the chip's addresses.
void halve_addresses(Program& program);

}  // namespace dspic::link
