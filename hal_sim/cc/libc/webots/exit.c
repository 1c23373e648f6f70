/* SPDX-License-Identifier: MIT
 * Firmware libc: exit() of programs written for Webots' interfaces. With 0 the program has ended: nothing is restarted,
 * wheels and LEDs stay as they are. A failure is reported, as of other firmware. */
#include <stdlib.h>
#include "hal_sim/host/image_abi.h"

void exit(int status)
{
  while (status == 0) tp_power_save(1);
  tp_trap_message(TP_TRAP_ABORT, "exit() with a failure");
  for (;;) {
  }
}
