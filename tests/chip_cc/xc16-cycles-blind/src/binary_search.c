// SPDX-License-Identifier: MIT
/* binary_search: index of a value in a sorted table. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const int sorted[16] = {-50, -20, -3, 0, 2, 5, 9, 17, 33, 64, 70, 99, 130, 200, 512, 900};
NOINLINE int binary_search(const int* v, int n, int wanted) {
  int low = 0, high = n - 1;
  while (low <= high) {
    int middle = (low + high) >> 1;
    if (v[middle] == wanted) return middle;
    if (v[middle] < wanted)
      low = middle + 1;
    else
      high = middle - 1;
  }
  return -1;
}

/* fixed driver input */
long bench_run(void) {
  return binary_search(sorted, 16, 64) + 20L * binary_search(sorted, 16, -50) + binary_search(sorted, 16, 65);
}
