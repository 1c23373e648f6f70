/* SPDX-License-Identifier: MIT
 * Firmware libc: names of types that programs from elsewhere use. */
#ifndef TP_LIBC_SYS_TYPES_H
#define TP_LIBC_SYS_TYPES_H
#include <stddef.h>
typedef int ssize_t;
typedef long off_t;
#endif
