// SPDX-License-Identifier: MIT
// A bound on what a process may ask for: a macro without end shall not take the machine with it.
#pragma once
#include <cstdint>
#include <string>

namespace cc {

/// Memory that one compiler, assembler or linker of ours may ask for, bytes.
inline constexpr std::uint64_t kMostToolBytes =
    std::uint64_t{1} << 30;  // [measured: the largest file of our programs takes 250 MB]
/// And one of others', such as that of programs of the PC, bytes.
inline constexpr std::uint64_t kMostChildBytes = std::uint64_t{3}
                                                 << 30;  // [assumed: templates of C++ take some]

/// A file that a tool may write, bytes.
inline constexpr std::uint64_t kMostToolFileBytes =
    std::uint64_t{64} << 20;  // [measured: ten times the largest image with its debug information]

/// Processor time of one of these, s.
inline constexpr unsigned kMostToolSeconds = 60;  // [measured: the slowest file of our programs takes 2 s]

/// Bounds this process's memory, as far as it is not bounded more tightly. Only system calls.
void bound_memory(std::uint64_t bytes);
/// Does so, and says `what`: "FILE: memory: got more than 1024 MB, expected at most that; ...", exit code 1,
/// when more is asked for; the same of the files that it writes. Builds with a sanitizer bound files alone.
void limit_own_memory(const std::string& what);
/// The same of its processor time: "FILE: compile time: got more than 60 s of processor time, ...".
void limit_own_time(const std::string& what);
/// The words of limit_own_memory(), and its end.
[[noreturn]] void end_without_memory();

}  // namespace cc
