// SPDX-License-Identifier: MIT
#pragma once

namespace bench {

/// Million instructions that simavr (Debian's package) runs in a second of processor time: a loop like the
/// one of core_speed.cpp, in AVR's instructions, with or without 26,400 interrupts a simulated second.
double avr_rate(bool interrupts);

}  // namespace bench
