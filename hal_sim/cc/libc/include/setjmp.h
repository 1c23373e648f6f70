/* SPDX-License-Identifier: MIT
 * Firmware libc: jumps within one interrupt level. */
#ifndef TP_LIBC_SETJMP_H
#define TP_LIBC_SETJMP_H
typedef struct {
  void* __state[5];
  void* __caller; /* of the function that called setjmp() */
  int __value;
} jmp_buf[1];
#ifdef __cplusplus
extern "C" {
#endif
void tp_image_longjmp(void* __state, int* __value, int __v) __attribute__((__noreturn__));
int tp_image_note_caller(void* __state);
#define setjmp(b) (__builtin_setjmp((b)->__state) ? (b)->__value : tp_image_note_caller((b)->__state))
#define longjmp(b, v) tp_image_longjmp((b)->__state, &(b)->__value, v)
#ifdef __cplusplus
}
#endif
#endif
