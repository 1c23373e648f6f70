/* SPDX-License-Identifier: MIT
 * Firmware libc: types only. A robot has no calendar; calling time() or clock() is refused at build. */
#ifndef TP_LIBC_TIME_H
#define TP_LIBC_TIME_H
#include <stddef.h>
typedef long time_t;
typedef unsigned long clock_t;
time_t time(time_t* to);
clock_t clock(void);
#endif
