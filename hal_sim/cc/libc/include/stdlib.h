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
void* malloc(size_t bytes);
void* calloc(size_t n, size_t bytes);
void* realloc(void* old, size_t bytes);
void free(void* block);
int atoi(const char* s);
long atol(const char* s);
double atof(const char* s);
long strtol(const char* s, char** end, int base);
unsigned long strtoul(const char* s, char** end, int base);
double strtod(const char* s, char** end);
int abs(int v);
long labs(long v);
div_t div(int a, int b);
ldiv_t ldiv(long a, long b);
int rand(void);
void srand(unsigned int seed);
void qsort(void* first, size_t n, size_t bytes, int (*compare)(const void*, const void*));
void* bsearch(const void* key, const void* first, size_t n, size_t bytes,
              int (*compare)(const void*, const void*));
void exit(int status) __attribute__((noreturn));
void abort(void) __attribute__((noreturn));
int atexit(void (*function)(void));
char* itoa(char* to, int value, int base);
#endif
