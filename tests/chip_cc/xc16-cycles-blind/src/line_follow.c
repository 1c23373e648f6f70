// SPDX-License-Identifier: MIT
/* line_follow: speeds from three ground sensors by cases. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int speed_left, speed_right;
NOINLINE void line_follow(int l, int m, int r) {
  int threshold = 500;
  if (m < threshold) {
    speed_left = 400;
    speed_right = 400;
  } else if (l < threshold && r >= threshold) {
    speed_left = 100;
    speed_right = 350;
  } else if (r < threshold && l >= threshold) {
    speed_left = 350;
    speed_right = 100;
  } else {
    speed_left = -200;
    speed_right = 200;
  }
}

/* fixed driver input */
long bench_run(void) {
  long sum = 0;
  line_follow(900, 100, 800);
  sum += speed_left;
  line_follow(300, 900, 800);
  sum += speed_left * 3 + speed_right;
  line_follow(800, 900, 400);
  sum += speed_left - speed_right;
  line_follow(900, 900, 900);
  return sum + speed_left;
}
