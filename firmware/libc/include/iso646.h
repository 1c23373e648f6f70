/* SPDX-License-Identifier: MIT
 * Firmware libc: operators in letters. */
#ifndef TP_LIBC_ISO646_H
#define TP_LIBC_ISO646_H
#ifndef __cplusplus
#define and &&
#define and_eq &=
#define bitand &
#define bitor |
#define compl ~
#define not !
#define not_eq !=
#define or ||
#define or_eq |=
#define xor ^
#define xor_eq ^=
#endif
#endif
