/* SPDX-License-Identifier: MIT
 * Firmware libc: time() as XC16's library has it, for the register way. A robot has no calendar: the function starts
 * timers 2 and 3 as a pair that counts cycles, unless timer 2 runs already, and returns what they count. */
#include <time.h>
#include "p30F6014A.h"

time_t time(time_t *to)
{
  time_t now;
  if (!T2CONbits.TON) {
    T2CONbits.T32 = 1;
    T2CONbits.TON = 1;
  }
  now = TMR2;
  now |= (time_t)TMR3HLD << 16;
  if (to) *to = now;
  return now;
}
