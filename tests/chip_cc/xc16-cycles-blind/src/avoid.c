// SPDX-License-Identifier: MIT
/* avoid: weighted sum of eight sensors for both wheels. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const int weight_left[8] = {-10, -8, -5, 1, 1, 5, 8, 10};
static const int weight_right[8] = {10, 8, 5, 1, 1, -5, -8, -10};
static int wheels[2];
NOINLINE void avoid(const int* prox) {
  int i, l = 0, r = 0;
  for (i = 0; i < 8; i++) {
    l += weight_left[i] * (prox[i] >> 4);
    r += weight_right[i] * (prox[i] >> 4);
  }
  wheels[0] = 300 + l / 8;
  wheels[1] = 300 + r / 8;
}

/* fixed driver input */
static int prox[8] = {1200, 400, 90, 20, 30, 15, 64, 200};
long bench_run(void) {
  avoid(prox);
  return wheels[0] * 10L + wheels[1];
}
