/* SPDX-License-Identifier: MIT
 * Delay loops: about 10 cycles a round. In files of their own, since many programs have a wait() of theirs.
 * Source: [lib: utility/utility.c], facts restated.
 */
#include "hal.h"
#include "utility/utility.h"

void wait(long num) {
  long i;
  for (i = 0; i < num; i++) {
    NOP();
    NOP();
    NOP();
    NOP();
  }
}
