// SPDX-License-Identifier: MIT
/* selection_sort: selection sort of bytes. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static unsigned char bytes[9] = {200, 3, 77, 41, 255, 0, 12, 90, 13};
NOINLINE void selection_sort(unsigned char* v, int n) {
  int i, j;
  for (i = 0; i < n - 1; i++) {
    int least = i;
    unsigned char t;
    for (j = i + 1; j < n; j++)
      if (v[j] < v[least]) least = j;
    t = v[i];
    v[i] = v[least];
    v[least] = t;
  }
}

/* fixed driver input */
long bench_run(void) {
  selection_sort(bytes, 9);
  return bytes[0] + 10L * bytes[4] + 100L * bytes[8];
}
