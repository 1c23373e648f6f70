// SPDX-License-Identifier: MIT
/* shell_sort: shell sort with gaps that halve. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int heap[12] = {31, 4, 15, 92, 65, 35, 89, 79, 3, 23, 84, 62};
NOINLINE void shell_sort(int* v, int n) {
  int gap, i, j;
  for (gap = n / 2; gap > 0; gap /= 2)
    for (i = gap; i < n; i++) {
      int x = v[i];
      for (j = i; j >= gap && v[j - gap] > x; j -= gap) v[j] = v[j - gap];
      v[j] = x;
    }
}

/* fixed driver input */
long bench_run(void) {
  shell_sort(heap, 12);
  return heap[0] + 1000L * heap[6] + heap[11];
}
