// SPDX-License-Identifier: MIT
/* read_number: decimal text with sign to a whole number. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

NOINLINE int read_number(const char* s) {
  int value = 0, negative = 0;
  while (*s == ' ') s++;
  if (*s == '-') {
    negative = 1;
    s++;
  }
  while (*s >= '0' && *s <= '9') {
    value = value * 10 + (*s - '0');
    s++;
  }
  return negative ? -value : value;
}

/* fixed driver input */
long bench_run(void) { return read_number("  1234") + read_number("-987x") + read_number("7"); }
