// SPDX-License-Identifier: MIT
// Functions by the names that people use: with code of their own, as copies in others, or played by the
// simulator. Whoever is asked about one (budgets, cost_of(), the debugger) says the same of it.
#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "dspic30/load/firmware_file.h"

namespace chip {

/// Where copies of a function begin that the compiler put into others; by address, each once.
std::vector<std::uint32_t> copies_of(const dspic::FirmwareFile& file, const std::string& function);

/// Names of the functions that hold them.
std::set<std::string> holders_of(const dspic::FirmwareFile& file, const std::string& function);

/// How a function is measured that has copies in others, "; to measure it alone ...". The one
/// home of this advice.
extern const char* const kMeasureAlone;

/// What is said behind the times of a function with code, of which copies were not measured: "; its copies in
/// main() are not counted; to measure ...". Empty: it has none.
std::string copies_note(const dspic::FirmwareFile& file, const std::string& function);

/// Why a name is no function with code of its own: "is part of main(); to measure it alone, ...", "is played
/// by the simulator ...", "is not in the program; did you mean ...?". Empty: it has code.
std::string why_no_code(const dspic::FirmwareFile& file, const std::string& function);

}  // namespace chip
