// SPDX-License-Identifier: MIT
// All routines that are known by heart: those of hal_dspic/runtime, of the firmware's C library, and of the
// I2C master, as this compiler makes them. Each form is bound to the very code that it was made for
// (KnownRoutine::code): after a change of the routine or of the compiler it is not found any more and the
// routine runs, until its form is looked at again; tests/routines/routines_test.cpp tells.
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dspic30/core/known_calls.h"
#include "dspic30/core/known_routine.h"
#include "dspic30/routines/routine_code.h"

namespace dspic {

/// By kind.
const std::vector<KnownRoutine>& long_division_routines();
const std::vector<KnownRoutine>& long_long_routines();
const std::vector<KnownRoutine>& float_routines();
const std::vector<KnownRoutine>& float_comparison_routines();
const std::vector<KnownRoutine>& float_conversion_routines();
const std::vector<KnownRoutine>& float_root_routines();
const std::vector<KnownRoutine>& memory_routines();
/// Of hal_dspic/I2C. Their sums hide a variable.
const std::vector<KnownRoutine>& i2c_routines();

/// The handlers of hal_dspic/uart.
KnownHandler uart_handler();

std::vector<const KnownRoutine*> known_routines();

/// What this code is; null: no known routine. `name`: its symbol, as in FirmwareFile::functions; empty: the
/// image has no symbols, its code says it all.
const KnownRoutine* find_known(const std::string& name, const ProgramMemory& program, unsigned address);

/// Where a program has known routines: symbols and their program addresses.
std::shared_ptr<const KnownCalls> known_calls(const std::map<std::string, std::uint32_t>& functions,
                                              const ProgramMemory& program);

}  // namespace dspic
