/* SPDX-License-Identifier: MIT
 * Firmware libc: formatted text; printf() ends in write(), which sends to the UART that __C30_UART names,
 * as with XC16. There are no files. */
#ifndef TP_LIBC_STDIO_H
#define TP_LIBC_STDIO_H
#include <stdarg.h>
#include <stddef.h>
#define EOF (-1)
#define BUFSIZ 128
typedef struct tp_file FILE;
extern FILE* const tp_stdout;
#define stdout tp_stdout
#define stderr tp_stdout
int printf(const char* format, ...) __attribute__((format(printf, 1, 2)));
int vprintf(const char* format, va_list list);
int fprintf(FILE* to, const char* format, ...) __attribute__((format(printf, 2, 3)));
int vfprintf(FILE* to, const char* format, va_list list);
int sprintf(char* to, const char* format, ...) __attribute__((format(printf, 2, 3)));
int snprintf(char* to, size_t size, const char* format, ...) __attribute__((format(printf, 3, 4)));
int vsprintf(char* to, const char* format, va_list list);
int vsnprintf(char* to, size_t size, const char* format, va_list list);
int sscanf(const char* s, const char* format, ...) __attribute__((format(scanf, 2, 3)));
int vsscanf(const char* s, const char* format, va_list list);
int puts(const char* s);
int fputs(const char* s, FILE* to);
int putchar(int c);
int fputc(int c, FILE* to);
int putc(int c, FILE* to);
int fflush(FILE* to);
/* 1 or 2: the UART that printf() and its like write to */
extern int __C30_UART;
#endif
