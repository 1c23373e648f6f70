/* SPDX-License-Identifier: MIT
 * Firmware libc: jumps within one interrupt level. */
#ifndef TP_LIBC_SETJMP_H
#define TP_LIBC_SETJMP_H
typedef unsigned int jmp_buf[11]; /* W8 to W15, return address, SPLIM */
int setjmp(jmp_buf __state) __attribute__((__returns_twice__));
void longjmp(jmp_buf __state, int __value) __attribute__((__noreturn__));
#endif
