// SPDX-License-Identifier: MIT
/* high_pass: difference to the sample before, kept in a static. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int last_sample;
NOINLINE int high_pass(int sample) {
  int d = sample - last_sample;
  last_sample = sample;
  if (d > 500)
    d = 500;
  else if (d < -500)
    d = -500;
  return d;
}

/* fixed driver input */
long bench_run(void) {
  long sum = high_pass(100);
  sum = 3 * sum + high_pass(900);
  sum = 3 * sum + high_pass(-200);
  return 3 * sum + high_pass(-190);
}
