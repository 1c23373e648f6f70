/* SPDX-License-Identifier: MIT
 * Twin of XC16's own delay, for the register way: with XC16 the vendor's is linked.
 */
#ifdef __TWINPUCK_PC__
#include "libpic30.h"

#define LEAST_CYCLES 12 /* call, test and return take this much even for shorter delays */

/* the clock of the register way, and a wait for it */
long long tp_now(void);
void tp_wait_until(long long cycle);

void __delay32(unsigned long cycles) { tp_wait_until(tp_now() + (cycles < LEAST_CYCLES ? LEAST_CYCLES : (long long)cycles)); }

#endif
