// SPDX-License-Identifier: MIT
#include "hal_sim/api/call_cycles.h"

namespace api {

const CallCycles& call_cycles(Level level) {
  static constexpr CallCycles kLevels[] = {
      {
#define CALL_CYCLES(name, what, o0, o1, o2, os) o0,
#include "hal_sim/api/call_cycles.inc"
#undef CALL_CYCLES
      },
      {
#define CALL_CYCLES(name, what, o0, o1, o2, os) o1,
#include "hal_sim/api/call_cycles.inc"
#undef CALL_CYCLES
      },
      {
#define CALL_CYCLES(name, what, o0, o1, o2, os) o2,
#include "hal_sim/api/call_cycles.inc"
#undef CALL_CYCLES
      },
      {
#define CALL_CYCLES(name, what, o0, o1, o2, os) os,
#include "hal_sim/api/call_cycles.inc"
#undef CALL_CYCLES
      },
  };
  return kLevels[static_cast<int>(level)];
}

}  // namespace api
