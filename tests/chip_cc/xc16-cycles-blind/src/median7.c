// SPDX-License-Identifier: MIT
/* median7: median of seven by insertion into a local array. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

NOINLINE int median7(const int* v) {
  int s[7], i, j;
  for (i = 0; i < 7; i++) {
    int x = v[i];
    for (j = i; j > 0 && s[j - 1] > x; j--) s[j] = s[j - 1];
    s[j] = x;
  }
  return s[3];
}

/* fixed driver input */
static int window[7] = {9, 3, 7, 1, 8, 2, 5};
long bench_run(void) {
  int m = median7(window);
  window[3] = 99;
  return m * 100 + median7(window);
}
