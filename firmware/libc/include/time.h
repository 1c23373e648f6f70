/* SPDX-License-Identifier: MIT
 * Firmware libc: a robot has no calendar. time() and clock() count cycles, as XC16's do, in timers 2 and 3. */
#ifndef TP_LIBC_TIME_H
#define TP_LIBC_TIME_H
#include <stddef.h>
typedef long time_t;
typedef unsigned long clock_t;
time_t time(time_t* __to);
clock_t clock(void);
#define CLOCKS_PER_SEC 1000000L
double difftime(time_t later, time_t earlier);
#endif
