/* SPDX-License-Identifier: MIT
 * The library's own delay: 10 cycles a round, as wait().
 */
#include "hal.h"

void hal_pause(unsigned int rounds) {
  if (rounds == 0) return;
  do {
    NOP();
    NOP();
    NOP();
    NOP();
    NOP();
    NOP();
    NOP();
  } while (--rounds != 0);
}
