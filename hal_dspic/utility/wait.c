/* SPDX-License-Identifier: MIT
 * Delay loops: 10 cycles a round. They count down, which XC16 and our own compiler do alike at -O1 and -O2. In files of
 * their own, since many programs have a wait() of theirs.
 * Source: [lib: utility/utility.c], facts restated.
 */
#include "hal.h"
#include "utility/utility.h"

void wait(long num) {
  if (num <= 0) return;
  do {
    NOP();
    NOP();
    NOP();
    NOP();
    NOP();
    NOP();
  } while (--num != 0);
}
