/* SPDX-License-Identifier: MIT
 * Firmware libc: sizes have 16 bits as on the robot, pointers have the PC's width. */
#ifndef TP_LIBC_STDDEF_H
#define TP_LIBC_STDDEF_H
typedef __SIZE_TYPE__ size_t;
typedef __PTRDIFF_TYPE__ ptrdiff_t;
#ifdef __cplusplus
typedef decltype(nullptr) nullptr_t;
typedef struct {
  long long number;
  double fraction;
} max_align_t;
#else
typedef __WCHAR_TYPE__ wchar_t;
#endif
#ifndef NULL
#ifdef __cplusplus
#define NULL __null
#else
#define NULL ((void*)0)
#endif
#endif
#define offsetof(type, member) __builtin_offsetof(type, member)
#endif
