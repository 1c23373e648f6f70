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
int printf(const char* __format, ...) __attribute__((__format__(__printf__, 1, 2)));
int vprintf(const char* __format, va_list __list);
int fprintf(FILE* __to, const char* __format, ...) __attribute__((__format__(__printf__, 2, 3)));
int vfprintf(FILE* __to, const char* __format, va_list __list);
int sprintf(char* __to, const char* __format, ...) __attribute__((__format__(__printf__, 2, 3)));
int snprintf(char* __to, size_t __size, const char* __format, ...)
    __attribute__((__format__(__printf__, 3, 4)));
int vsprintf(char* __to, const char* __format, va_list __list);
int vsnprintf(char* __to, size_t __size, const char* __format, va_list __list);
int sscanf(const char* __s, const char* __format, ...) __attribute__((__format__(__scanf__, 2, 3)));
int vsscanf(const char* __s, const char* __format, va_list __list);
int puts(const char* __s);
int fputs(const char* __s, FILE* __to);
int putchar(int __c);
int fputc(int __c, FILE* __to);
int putc(int __c, FILE* __to);
int fflush(FILE* __to);
/* 1 or 2: the UART that printf() and its like write to */
extern int __C30_UART;
#endif
