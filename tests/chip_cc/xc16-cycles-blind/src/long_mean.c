// SPDX-License-Identifier: MIT
/* long_mean: mean of 32-bit numbers. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const long times[6] = {100000, 250000, -30000, 123456, 7, 999999};
NOINLINE long long_mean(const long* v, int n) {
  long sum = 0;
  int i;
  for (i = 0; i < n; i++) sum += v[i];
  return sum / n;
}

/* fixed driver input */
long bench_run(void) { return long_mean(times, 6) - long_mean(times, 3); }
