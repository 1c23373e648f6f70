// SPDX-License-Identifier: MIT
// Whoever makes native code of instructions that run often (dspic30/translate).
#pragma once
#include <cstddef>

#include "dspic30/core/decoded.h"

namespace dspic {

class Cpu;

/// Native code of instructions that run often: the instructions' own functions put together, so it does what
/// they would do, to the cycle (dspic30/translate). It runs one instruction at least; as with its own
/// function, the cycles of the first one are not counted.
struct Translation {
  Run run = nullptr;                   ///< null: not worth it
  std::ptrdiff_t first = 0, last = 0;  ///< words from the head, all that it holds is between them
};
class Translator {
 public:
  virtual ~Translator() = default;
  /// `only_ready`: what costs hardly anything, because an earlier run left it; or is worth it, because one
  /// noted it as warm.
  virtual Translation translate(const Cpu& cpu, const Decoded* head, bool only_ready) = 0;
  /// It runs often, though not so often that this run would gain by a translation: the next one would.
  virtual void note_warm(const Cpu& /*cpu*/, const Decoded* /*head*/) {}
};

}  // namespace dspic
