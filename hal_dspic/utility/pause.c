/* SPDX-License-Identifier: MIT
 * The library's own delay, as its text has it in several places: a long that is counted down, XC16's 4 cycles a round at
 * -O1 and 11 at -O0.
 */
#include "hal.h"

void hal_pause(unsigned int rounds) {
  long i;
  for (i = rounds; i; i--) continue;
}
