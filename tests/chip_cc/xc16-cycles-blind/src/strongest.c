// SPDX-License-Identifier: MIT
/* strongest: number of the strongest of eight sensors, and how strong. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int strength;
NOINLINE int strongest(const int* v) {
  int i, best = 0;
  for (i = 1; i < 8; i++)
    if (v[i] > v[best]) best = i;
  strength = v[best];
  return best;
}

/* fixed driver input */
static int prox[8] = {20, 310, 55, 1999, 4, 2001, 18, 90};
long bench_run(void) {
  int a = strongest(prox), b;
  prox[5] = 1;
  b = strongest(prox);
  return a * 10 + b + 100L * strength;
}
