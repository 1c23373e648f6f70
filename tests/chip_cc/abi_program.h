// SPDX-License-Identifier: MIT
// C programs about how arguments and results travel: structs and unions of 0 to 20 bytes, of each kind of
// member, by value, as results, behind "...", by pointers to functions, when registers have run out, at odd
// addresses. Each function mixes what arrived into a sum; another compiler makes the same program, and its
// sum is the second opinion. Nothing in a sum depends on how a compiler aligns or pads, nor on the width of
// its int.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace chip_cc {

/// Several cases as one program, so that one build asks them all.
struct AbiProgram {
  std::string what;                // "unions, 0 to 6 bytes"
  std::vector<std::string> parts;  // each a case, run by its run_part_N()
  std::vector<std::string> names;  // of the cases

  std::string source() const;  // bench_run() returns the sum of all
  std::string source_of(std::size_t part) const;
};

/// Each shape of struct in each size: 0 to 20 bytes.
std::vector<AbiProgram> abi_programs_by_shape();
/// Signatures by chance: `count` cases of the seeds from `first` on.
AbiProgram abi_program_by_chance(std::uint32_t first, int count);

/// Compiled by avr-gcc, which also has an int of 16 bits and a double of 32, and run by simavr. 0xDEAD0000:
/// one of them failed, `error` says how.
std::uint32_t result_on_avr(const std::string& source, std::string& error);

}  // namespace chip_cc
