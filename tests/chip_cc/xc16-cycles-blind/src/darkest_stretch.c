// SPDX-License-Identifier: MIT
/* darkest_stretch: middle of the darkest five pixels of a camera line. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static unsigned char line[30] = {99, 98, 97, 99, 90, 91, 92, 90, 60, 30, 20, 18, 19, 25, 61,
                                 90, 92, 93, 94, 95, 96, 97, 99, 98, 97, 96, 95, 90, 89, 88};
NOINLINE int darkest_stretch(const unsigned char* p, int n) {
  int i, sum = 0, least, best = 2;
  for (i = 0; i < 5; i++) sum += p[i];
  least = sum;
  for (i = 5; i < n; i++) {
    sum += p[i] - p[i - 5];
    if (sum < least) {
      least = sum;
      best = i - 2;
    }
  }
  return best;
}

/* fixed driver input */
long bench_run(void) { return darkest_stretch(line, 30); }
