/* SPDX-License-Identifier: MIT
 * Firmware libc: formatted text; printf() ends in write(), which sends to the UART that __C30_UART names,
 * as with XC16. There are no files: who calls what is declared for them is told so. */
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
size_t fwrite(const void* __from, size_t __bytes, size_t __n, FILE* __to);
#define SEEK_SET 0
#define SEEK_CUR 1
#define SEEK_END 2
FILE* fopen(const char* __name, const char* __mode);
int fclose(FILE* __file);
size_t fread(void* __to, size_t __bytes, size_t __n, FILE* __from);
int fgetc(FILE* __from);
int getc(FILE* __from);
int ungetc(int __c, FILE* __from);
char* fgets(char* __to, int __size, FILE* __from);
int fscanf(FILE* __from, const char* __format, ...) __attribute__((__format__(__scanf__, 2, 3)));
int fseek(FILE* __file, long __offset, int __from);
long ftell(FILE* __file);
void rewind(FILE* __file);
int feof(FILE* __file);
int ferror(FILE* __file);
void clearerr(FILE* __file);
int remove(const char* __name);
void perror(const char* __text);
/* 1 or 2: the UART that printf() and its like write to */
extern int __C30_UART;
#endif
