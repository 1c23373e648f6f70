/* SPDX-License-Identifier: MIT
 * time() and clock() as XC16's library has them, for our own compiler: with XC16 the vendor's are linked. A
 * robot has no calendar: both start timers 2 and 3 as a pair that counts cycles, unless timer 2 runs already,
 * and return what they count.
 */
#ifdef __TWINPUCK__
#include <p30F6014A.h>
#include <time.h>

time_t time(time_t* to) {
  time_t now;
  if (!T2CONbits.TON) {
    T2CONbits.T32 = 1;
    T2CONbits.TON = 1;
  }
  now = TMR2; /* which holds timer 3 */
  now |= (time_t)TMR3HLD << 16;
  if (to) *to = now;
  return now;
}

clock_t clock(void) { return (clock_t)time(0); }

double difftime(time_t later, time_t earlier) { return (double)(later - earlier); }

#endif
