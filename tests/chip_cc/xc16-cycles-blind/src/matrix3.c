// SPDX-License-Identifier: MIT
/* matrix3: product of two 3 by 3 matrices. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int left_m[3][3] = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
static int right_m[3][3] = {{2, 0, 1}, {-1, 3, 5}, {4, 4, -2}};
static int product[3][3];
NOINLINE void matrix3(int (*a)[3], int (*b)[3], int (*out)[3]) {
  int i, j, k;
  for (i = 0; i < 3; i++)
    for (j = 0; j < 3; j++) {
      int sum = 0;
      for (k = 0; k < 3; k++) sum += a[i][k] * b[k][j];
      out[i][j] = sum;
    }
}

/* fixed driver input */
long bench_run(void) {
  matrix3(left_m, right_m, product);
  return product[0][0] + 10 * product[1][1] + 100 * product[2][2] + product[2][0];
}
