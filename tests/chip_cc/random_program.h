// SPDX-License-Identifier: MIT
// C programs made up by chance, of what the chip's compiler must get right: arithmetic of all widths, shifts,
// divisions, comparisons, loops, switches, arrays, structs, calls with many arguments. bench_run() returns a
// checksum. Nothing in them is undefined where signed arithmetic wraps, and the PC compiles them with types
// of the chip's widths.
#pragma once
#include <cstdint>
#include <string>

namespace chip_cc {

std::string random_program(std::uint32_t seed);
/// Those of the seeds `first` on as one, whose checksum is made of theirs.
std::string random_programs(std::uint32_t first, int count);
/// Compiled by clang and run here.
std::uint32_t result_on_pc(const std::string& source);

}  // namespace chip_cc
