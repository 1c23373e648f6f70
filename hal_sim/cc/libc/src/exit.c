/* SPDX-License-Identifier: MIT
 * Firmware libc: exit(). */
#include <stdlib.h>
#include "hal_sim/host/image_abi.h"

void exit(int status)
{
  if (status == 0) tp_reset();
  tp_trap_message(TP_TRAP_ABORT, "exit() with a failure");
  for (;;) {
  }
}
