// SPDX-License-Identifier: MIT
// pins_remote.h on the board.
#include "hal_sim/board/board.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins_remote.h"

using host::Context;

extern "C" {

tp_i64 tp_remote_level(void) {
  Context& context = Context::current();
  const host::Cycle now = context.now();
  const board::RemoteReceiver& remote = context.board().remote();
  context.lower_horizon(remote.horizon(now));
  return remote.level(now) ? 1 : 0;
}

}  // extern "C"
