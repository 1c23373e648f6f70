/* SPDX-License-Identifier: MIT
 * Firmware libc: sorting, chance, leaving; numbers.c reads numbers. exit(0) and a return from main restart the program
 * on the robot; exit(n) and abort() are traps here, so nobody mistakes them for a quiet end. */
#include <stdlib.h>
#include <tp_runtime.h>

int errno;

int abs(int v) { return v < 0 ? -v : v; }
long labs(long v) { return v < 0 ? -v : v; }
long long llabs(long long v) { return v < 0 ? -v : v; }

div_t div(int a, int b)
{
  div_t r;
  r.quot = a / b, r.rem = a % b;
  return r;
}

ldiv_t ldiv(long a, long b)
{
  ldiv_t r;
  r.quot = a / b, r.rem = a % b;
  return r;
}

lldiv_t lldiv(long long a, long long b)
{
  lldiv_t r;
  r.quot = a / b, r.rem = a % b;
  return r;
}

/* the example of the C standard (7.20.2.2), which XC16's library uses as well */
static unsigned long random_state = 1;

void srand(unsigned int seed) { random_state = seed; }

int rand(void)
{
  random_state = random_state * 1103515245ul + 12345ul;
  return (int)(random_state >> 16) & RAND_MAX;
}

static void swap(char *a, char *b, size_t n)
{
  while (n--) {
    char t = *a;
    *a++ = *b;
    *b++ = t;
  }
}

/* heap sort: no recursion, no extra memory */
static void sift(char *first, size_t root, size_t n, size_t bytes, int (*compare)(const void *, const void *))
{
  for (;;) {
    size_t child = 2 * root + 1;
    if (child >= n) return;
    if (child + 1 < n && compare(first + child * bytes, first + (child + 1) * bytes) < 0) child++;
    if (compare(first + root * bytes, first + child * bytes) >= 0) return;
    swap(first + root * bytes, first + child * bytes, bytes);
    root = child;
  }
}

void qsort(void *base, size_t n, size_t bytes, int (*compare)(const void *, const void *))
{
  char *first = base;
  size_t i;
  if (n < 2) return;
  for (i = n / 2; i-- > 0;) sift(first, i, n, bytes, compare);
  for (i = n - 1; i > 0; i--) {
    swap(first, first + i * bytes, bytes);
    sift(first, 0, i, bytes, compare);
  }
}

void *bsearch(const void *key, const void *base, size_t n, size_t bytes, int (*compare)(const void *, const void *))
{
  const char *first = base;
  while (n) {
    const char *middle = first + (n / 2) * bytes;
    int order = compare(key, middle);
    if (order == 0) return (void *)middle;
    if (order > 0) first = middle + bytes, n -= n / 2 + 1;
    else n /= 2;
  }
  return 0;
}

void abort(void)
{
  tp_give_up();
}

int atexit(void (*function)(void)) { return function == 0; /* the program of a robot never ends */ }

char *itoa(char *to, int value, int base)
{
  char digits[18], *p = digits + sizeof digits;
  unsigned int v = value < 0 && base == 10 ? 0U - (unsigned int)value : (unsigned int)value;
  char *t = to;
  *--p = 0;
  do {
    *--p = "0123456789abcdefghijklmnopqrstuvwxyz"[v % (unsigned int)base];
    v /= (unsigned int)base;
  } while (v);
  if (value < 0 && base == 10) *t++ = '-';
  while ((*t++ = *p++)) {
  }
  return to;
}

/* not in any standard, but programs for the robot call them without a definition of their own; theirs wins if they have one */
int min(int a, int b) { return a < b ? a : b; }
int max(int a, int b) { return a > b ? a : b; }
