// SPDX-License-Identifier: MIT
/* loudness: peak and energy of a microphone buffer. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int buffer[12] = {2050, 2100, 1990, 2300, 1700, 2049, 2048, 2047, 2500, 1500, 2060, 2040};
static int peak;
NOINLINE long loudness(const int* v, int n) {
  long energy = 0;
  int i;
  peak = 0;
  for (i = 0; i < n; i++) {
    int d = v[i] - 2048;
    if (d < 0) d = -d;
    if (d > peak) peak = d;
    energy += (long)d * d;
  }
  return energy;
}

/* fixed driver input */
long bench_run(void) {
  long energy = loudness(buffer, 12);
  return energy + peak;
}
