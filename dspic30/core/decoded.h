// SPDX-License-Identifier: MIT
// A word of flash made ready to run.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace dspic {

class Cpu;
struct Decoded;
/// Executes an instruction; returns the next one.
using Run = const Decoded* (*)(Cpu&, const Decoded*);

/// How a register serves as a pointer: by an addition, as the stack's, or modulo or bit-reversed.
enum class Pointer : std::uint8_t { Plain, Stack, Special };

struct Decoded {
  mutable std::atomic<Run> run{nullptr};
  std::int32_t imm = 0;         ///< literal, address, words of a branch, shift
  std::uint16_t writes = 0;     ///< registers written directly, or changed as a destination's pointer
  std::uint16_t pointers = 0;   ///< registers that form a source's address
  std::uint16_t mask = 0xFFFF;  ///< of what register d can hold: W15 is even
  std::uint8_t s = 0, d = 0, b = 0;
  std::uint8_t cycles = 1;  ///< stall included
  std::uint8_t lead = 0;    ///< stall cycles, when it follows the word before
  std::uint8_t psv = 2;     ///< what reading through the PSV window costs
  std::int8_t s_pre = 0, s_post = 0, d_pre = 0, d_post = 0;
  Pointer s_kind = Pointer::Plain, d_kind = Pointer::Plain;
  enum State : std::uint8_t { Unmet, Met, Fronted };
  mutable std::atomic<State> state{Unmet};  ///< Fronted: `run` is not its own function: CodeTable::plain()
  /// Counts jumps to here down to 1, when it is warm; 0: they do not count.
  mutable std::atomic<std::uint8_t> heat{0};

  Decoded() = default;
  Decoded(const Decoded& other) { *this = other; }
  Decoded& operator=(const Decoded& other);
};
static_assert(sizeof(Decoded) == 32);

/// From the first of a program's words to one of them; of any other place a number that means nothing.
inline std::size_t words_between(const Decoded* first, const Decoded* word) {
  return (reinterpret_cast<std::uintptr_t>(word) - reinterpret_cast<std::uintptr_t>(first)) / sizeof(Decoded);
}

}  // namespace dspic
