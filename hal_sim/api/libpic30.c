/* SPDX-License-Identifier: MIT
 * Delays and clock of XC16's own library.
 */
#include "libpic30.h"

#include <time.h>

#include "hal_sim/host/pins.h"

/* call, test and return take this much even for shorter delays */
#define LEAST_CYCLES 12

void __delay32(unsigned long cycles) {
  tp_i64 wanted = cycles < LEAST_CYCLES ? LEAST_CYCLES : cycles;
  tp_wait_until(tp_now() + wanted);
}

/* time() and clock() of the robot count cycles from the first call on, in timers 2 and 3 unless somebody else has
 * them. There is no calendar. */
static tp_i64 clock_start = -1;

time_t time(time_t *to) {
  time_t now;
  if (clock_start < 0) clock_start = tp_now();
  now = (time_t)(tp_now() - clock_start);
  if (to) *to = now;
  return now;
}

clock_t clock(void) { return (clock_t)time(0); }

double difftime(time_t later, time_t earlier) { return (double)(later - earlier); }
