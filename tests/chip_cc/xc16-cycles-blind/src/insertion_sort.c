// SPDX-License-Identifier: MIT
/* insertion_sort: insertion sort of whole numbers. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int list[10] = {5, -3, 90, 12, 12, 0, -77, 31, 8, 4};
NOINLINE void insertion_sort(int* v, int n) {
  int i, j;
  for (i = 1; i < n; i++) {
    int x = v[i];
    j = i - 1;
    while (j >= 0 && v[j] > x) {
      v[j + 1] = v[j];
      j--;
    }
    v[j + 1] = x;
  }
}

/* fixed driver input */
long bench_run(void) {
  insertion_sort(list, 10);
  return list[0] + 100L * list[5] + list[9];
}
