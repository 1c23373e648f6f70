// SPDX-License-Identifier: MIT
/* edges: how often a signal crosses a level, with hysteresis. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

NOINLINE int edges(const int* v, int n, int level, int band) {
  int i, high = 0, count = 0;
  for (i = 0; i < n; i++) {
    if (!high && v[i] > level + band) {
      high = 1;
      count++;
    } else if (high && v[i] < level - band) {
      high = 0;
      count++;
    }
  }
  return count;
}

/* fixed driver input */
static int wave[14] = {0, 40, 60, 90, 55, 48, 61, 20, 10, 52, 70, 49, 30, 0};
long bench_run(void) { return edges(wave, 14, 50, 10) * 10 + edges(wave, 14, 50, 0); }
