// SPDX-License-Identifier: MIT
/* write_report: sensor values as text with commas. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static char report[40];
static char* put_number(char* to, unsigned int v) {
  char digits[5];
  int n = 0;
  do {
    digits[n++] = (char)('0' + v % 10);
    v /= 10;
  } while (v);
  while (n > 0) *to++ = digits[--n];
  return to;
}
NOINLINE int write_report(const unsigned int* v, int n) {
  char* to = report;
  int i;
  for (i = 0; i < n; i++) {
    if (i > 0) *to++ = ',';
    to = put_number(to, v[i]);
  }
  *to = 0;
  return (int)(to - report);
}

/* fixed driver input */
static unsigned int values[4] = {7, 120, 4095, 0};
long bench_run(void) {
  int n = write_report(values, 4);
  return n * 1000L + report[0] + report[4] * 2 + report[n - 1];
}
