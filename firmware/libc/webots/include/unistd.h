/* SPDX-License-Identifier: MIT
 * Firmware libc, for programs written for Webots' interfaces, many of which include it for nothing. What it
 * declares is refused when it is called: simulated time passes in wb_robot_step(). */
#ifndef TP_LIBC_UNISTD_H
#define TP_LIBC_UNISTD_H
unsigned int sleep(unsigned int seconds);
int usleep(unsigned long microseconds);
#endif
