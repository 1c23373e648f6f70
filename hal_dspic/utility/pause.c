/* SPDX-License-Identifier: MIT
 * The library's own delay: about 10 cycles a round.
 */
#include "hal.h"

void hal_pause(unsigned int rounds) {
  unsigned int i;
  for (i = 0; i < rounds; i++) {
    NOP();
    NOP();
    NOP();
    NOP();
    NOP();
    NOP();
  }
}
