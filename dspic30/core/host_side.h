// SPDX-License-Identifier: MIT
// What the core keeps of whoever plays the library (host_calls.h): when its handlers come, and which of its
// functions the program stands at.
#pragma once
#include <cstdint>

#include "dspic30/core/decoded.h"
#include "dspic30/core/host_calls.h"
#include "dspic30/memory/cycle.h"

namespace dspic {

class HostSide {
 public:
  /// What handlers take, or when one comes, may be another from now on.
  void host_changed() { host_stale = true; }

  HostCalls* host = nullptr;  ///< null: the program is all there is
  bool host_stale = true;
  bool host_followed = false;  ///< since Processor::run() looked last: its deadlines are of a clock of before
  bool host_comes = false;     ///< the handler that calls the program is not switched off
  bool host_is_held = true;    ///< one of the handlers is held off
  Cycle host_due = kNever;     ///< when the next one comes that calls the program
  Cycle stop_at = kNever;      ///< true time: `deadline` but for that handler and for looks
  Cycle soonest = kNever;      ///< ... and whatever the end of run()
  Cycle pause_at = kNever;     ///< ... when a look for a wait comes
  std::int64_t writes_seen = 0;     ///< to interrupt registers, when Processor::run() looked last
  bool host_again = false;          ///< the function of the host that stands there has been called already
  int host_handlers = 0;            ///< handlers known by heart under way, or left by a jump
  std::int64_t handlers_begun = 0;  ///< so far, those that came one by one and are no share
  Cycle stands_until = 0;           ///< a function of the host waits, and is asked again then
  const Decoded* stands_at = nullptr;
};

}  // namespace dspic
