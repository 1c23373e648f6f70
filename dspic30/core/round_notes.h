// SPDX-License-Identifier: MIT
// What is noted of a round of the program while somebody looks whether it is a wait (waits.h): what it read,
// and until when that stays as it is.
#pragma once
#include <algorithm>

#include "dspic30/memory/cycle.h"

namespace dspic {

class RoundMemory;  // known_waits.h
class Waits;        // waits.h

class RoundNotes {
 public:
  /// Something was done that a wait does not do.
  void note_effect() { watched_until = 0; }
  /// For host functions that look at something which stays so until then.
  void note_look(Cycle until) {
    looks_outside = true;
    watched_until = std::min(watched_until, until);
  }

  Waits* waits = nullptr;
  bool returned = false;         ///< a handler has, since Processor::run() looked last
  Cycle watched_until = kNever;  ///< what was read since skip_wait() began to look stays as it is until here
  bool watching = false;
  bool looks_outside = false;           ///< since then a register of a peripheral was read
  bool reads_core = false;              ///< ... or one of the core's, by its address; or DC
  RoundMemory* round_memory = nullptr;  ///< notes accesses to RAM: DataSpace::watch_round()
  /// Since when nothing that the program looks at can change but by an interrupt.
  Cycle still_since = kNever;
  bool still_reads = false;  ///< does such a round read anything at all?
};

}  // namespace dspic
