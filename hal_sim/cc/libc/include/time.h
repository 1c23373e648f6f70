/* SPDX-License-Identifier: MIT
 * Firmware libc: a robot has no calendar. time() and clock() count cycles in the register way; in the native
 * way they are refused at build, but for programs written for Webots' interfaces, whose calendar is
 * simulated. */
#ifndef TP_LIBC_TIME_H
#define TP_LIBC_TIME_H
#include <stddef.h>
typedef long time_t;
typedef unsigned long clock_t;
#ifdef __cplusplus
extern "C" {
#endif
time_t time(time_t* __to);
clock_t clock(void);
#define CLOCKS_PER_SEC 1000000L
double difftime(time_t later, time_t earlier);
#ifdef __cplusplus
}
#endif
#endif
