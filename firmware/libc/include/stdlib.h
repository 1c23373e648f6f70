/* SPDX-License-Identifier: MIT
 * Firmware libc: numbers, memory (a heap of 2048 bytes), rand() seeded per robot. */
#ifndef TP_LIBC_STDLIB_H
#define TP_LIBC_STDLIB_H
#include <stddef.h>
#define RAND_MAX 32767
#define EXIT_SUCCESS 0
#define EXIT_FAILURE 1
typedef struct {
  int quot, rem;
} div_t;
typedef struct {
  long quot, rem;
} ldiv_t;
typedef struct {
  long long quot, rem;
} lldiv_t;
void* malloc(size_t __bytes);
void* calloc(size_t __n, size_t __bytes);
void* realloc(void* __old, size_t __bytes);
void free(void* __block);
int atoi(const char* __s);
long atol(const char* __s);
long long atoll(const char* __s);
double atof(const char* __s);
long strtol(const char* __s, char** __end, int __base);
unsigned long strtoul(const char* __s, char** __end, int __base);
long long strtoll(const char* __s, char** __end, int __base);
unsigned long long strtoull(const char* __s, char** __end, int __base);
double strtod(const char* __s, char** __end);
float strtof(const char* __s, char** __end);
long double strtold(const char* __s, char** __end);
int abs(int __v);
long labs(long __v);
long long llabs(long long __v);
div_t div(int __a, int __b);
ldiv_t ldiv(long __a, long __b);
lldiv_t lldiv(long long __a, long long __b);
int rand(void);
void srand(unsigned int __seed);
void qsort(void* __first, size_t __n, size_t __bytes, int (*__compare)(const void*, const void*));
void* bsearch(const void* __key, const void* __first, size_t __n, size_t __bytes,
              int (*__compare)(const void*, const void*));
void exit(int __status) __attribute__((__noreturn__));
void abort(void) __attribute__((__noreturn__));
int atexit(void (*__function)(void));
#define MB_CUR_MAX 1
#ifndef __cplusplus
int mblen(const char* __s, size_t __n);
int mbtowc(wchar_t* __to, const char* __s, size_t __n);
int wctomb(char* __to, wchar_t __c);
size_t mbstowcs(wchar_t* __to, const char* __s, size_t __n);
size_t wcstombs(char* __to, const wchar_t* __s, size_t __n);
#endif
char* itoa(char* __to, int __value, int __base);
#endif
