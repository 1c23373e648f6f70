// SPDX-License-Identifier: MIT
// Sees a chip robot's program instruction by instruction: profiles, debuggers. It changes nothing, and a
// robot without one pays nothing.
#pragma once
#include "dspic30/core/processor.h"

namespace chip {

using dspic::Cycle;

/// What happened between two instruction boundaries: an instruction, an iteration of a REPEAT, the entry of a
/// handler, one that calls nothing, or sleep.
struct Step {
  Cycle begin = 0, end = 0;        ///< by the true clock
  Cycle took = 0;                  ///< of the program's own cycles: without the share of handlers by heart
  unsigned pc = 0;                 ///< of the instruction; at a handler's entry of the one that is put off
  unsigned next = 0;               ///< of the one that follows
  int entered = dspic::kNoVector;  ///< vector of the handler that begins
  Cycle flagged = -1;              ///< when its flag rose; -1: a trap's
  bool by_heart = false;           ///< it is the host's: the function that it calls first comes next
  bool served = false;             ///< a handler of the host's, from its entry to its end, and no instruction
  bool left = false;               ///< RETFIE
  bool slept = false;
};

class StepWatch {
 public:
  virtual ~StepWatch() = default;
  /// At a boundary, before anything happens there.
  virtual void before(Cycle /*at*/) {}
  virtual void after(const Step& /*step*/) {}
  /// The instruction at `pc` led to a reset: what comes instead of after().
  virtual void led_to_reset(unsigned /*pc*/) {}
  /// A reset: the program begins anew.
  virtual void was_reset(Cycle /*at*/) {}
};

}  // namespace chip
