/* SPDX-License-Identifier: MIT
 * Firmware libc: jumps within one interrupt level. */
#ifndef TP_LIBC_SETJMP_H
#define TP_LIBC_SETJMP_H
typedef struct {
  void* state[5];
  int value;
} jmp_buf[1];
void tp_image_longjmp(void* __state, int* __value, int __v) __attribute__((noreturn));
#define setjmp(b) (__builtin_setjmp((b)->state) ? (b)->value : 0)
#define longjmp(b, v) tp_image_longjmp((b)->state, &(b)->value, v)
#endif
