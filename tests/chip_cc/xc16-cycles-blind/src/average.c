// SPDX-License-Identifier: MIT
/* average: mean of an array. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const int readings[12] = {120, 340, 96, 1022, 511, 7, 230, 231, 229, 228, 640, 33};
NOINLINE int average(const int* v, int n) {
  long sum = 0;
  int i;
  for (i = 0; i < n; i++) sum += v[i];
  return (int)(sum / n);
}

/* fixed driver input */
long bench_run(void) { return average(readings, 12) + average(readings, 5); }
