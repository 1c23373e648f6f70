// SPDX-License-Identifier: MIT
/* low_pass: first-order filter of whole numbers over an array, in place. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int signal[10] = {0, 800, 810, 790, 20, 30, 25, 400, 410, 405};
NOINLINE void low_pass(int* v, int n) {
  int i, y = v[0];
  for (i = 1; i < n; i++) {
    y += (v[i] - y) >> 2;
    v[i] = y;
  }
}

/* fixed driver input */
long bench_run(void) {
  low_pass(signal, 10);
  low_pass(signal, 6);
  return signal[9] + 3L * signal[5];
}
