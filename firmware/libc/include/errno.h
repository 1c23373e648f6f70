/* SPDX-License-Identifier: MIT
 * Firmware libc: errno. */
#ifndef TP_LIBC_ERRNO_H
#define TP_LIBC_ERRNO_H
extern int errno;
#define EDOM 33
#define ERANGE 34
#endif
