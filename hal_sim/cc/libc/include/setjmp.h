/* SPDX-License-Identifier: MIT
 * Firmware libc: jumps within one interrupt level. */
#ifndef TP_LIBC_SETJMP_H
#define TP_LIBC_SETJMP_H
#ifdef __TWINPUCK_PC__
typedef struct {
  void* __state[5];
  void* __caller; /* of the function that called setjmp() */
  int __value;
} jmp_buf[1];
void tp_image_longjmp(void* __state, int* __value, int __v) __attribute__((__noreturn__));
int tp_image_note_caller(void* __state);
#define setjmp(b) (__builtin_setjmp((b)->__state) ? (b)->__value : tp_image_note_caller((b)->__state))
#define longjmp(b, v) tp_image_longjmp((b)->__state, &(b)->__value, v)
#else
typedef unsigned int jmp_buf[11]; /* W8 to W15, return address, SPLIM */
int setjmp(jmp_buf __state) __attribute__((__returns_twice__));
void longjmp(jmp_buf __state, int __value) __attribute__((__noreturn__));
#endif
#endif
