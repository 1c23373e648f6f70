// SPDX-License-Identifier: MIT
/* wall_follow: proportional and differential steering along a wall. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int error_before;
NOINLINE int wall_follow(int distance, int wanted) {
  int error = wanted - distance;
  int turn = error * 3 + (error - error_before) * 8;
  error_before = error;
  turn /= 4;
  if (turn > 300) turn = 300;
  if (turn < -300) turn = -300;
  return turn;
}

/* fixed driver input */
long bench_run(void) {
  long sum = wall_follow(310, 300);
  sum = 3 * sum + wall_follow(280, 300);
  return 3 * sum + wall_follow(900, 300);
}
