/* SPDX-License-Identifier: MIT
 * Delays of XC16's own library.
 */
#include "libpic30.h"

#include "hal_sim/host/pins.h"

/* call, test and return take this much even for shorter delays */
#define LEAST_CYCLES 12

void __delay32(unsigned long cycles) {
  tp_i64 wanted = cycles < LEAST_CYCLES ? LEAST_CYCLES : cycles;
  tp_wait_until(tp_now() + wanted);
}
