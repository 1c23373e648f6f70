/* SPDX-License-Identifier: MIT
 * Firmware libc: time() and clock() as XC16's library has them, for the register way. A robot has no calendar: both
 * start timers 2 and 3 as a pair that counts cycles, unless timer 2 runs already, and return what they count. */
#include <time.h>
#include "hal_sim/host/image_abi.h"

enum { kTmr2 = 0x106, kTmr3Hold = 0x108, kT2con = 0x110, kOn = 0x8000u, kPair = 0x0008 }; /* [DS70143 table 9-1] */

time_t time(time_t *to)
{
  time_t now;
  const tp_i64 control = tp_sfr_read(kT2con, 16);
  if (!(control & kOn)) {
    tp_sfr_write(kT2con, control | kPair, 16);
    tp_sfr_write(kT2con, control | kPair | kOn, 16);
  }
  now = (time_t)tp_sfr_read(kTmr2, 16); /* which holds timer 3 */
  now |= (time_t)tp_sfr_read(kTmr3Hold, 16) << 16;
  if (to) *to = now;
  return now;
}

clock_t clock(void) { return (clock_t)time(0); }
