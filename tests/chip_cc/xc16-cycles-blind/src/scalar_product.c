// SPDX-License-Identifier: MIT
/* scalar_product: scalar product of whole numbers in 32 bits. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const int a_row[9] = {3, -200, 45, 1000, 7, 0, -9, 88, 512};
static int b_row[9] = {100, 30, -7, 250, 900, 41, 5, -6, 12};
NOINLINE long scalar_product(const int* a, const int* b, int n) {
  long sum = 0;
  while (n-- > 0) sum += (long)*a++ * *b++;
  return sum;
}

/* fixed driver input */
long bench_run(void) { return scalar_product(a_row, b_row, 9) + scalar_product(b_row, b_row, 4); }
