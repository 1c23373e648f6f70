// SPDX-License-Identifier: MIT
/* odometry: position in whole numbers from steps of both wheels. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static long x_um, y_um;
static int heading;
NOINLINE void odometry(int left, int right, int cosine, int sine) {
  int middle = (left + right) / 2;
  heading += right - left;
  if (heading > 1800) heading -= 3600;
  if (heading < -1800) heading += 3600;
  x_um += ((long)middle * cosine) >> 6;
  y_um += ((long)middle * sine) >> 6;
}

/* fixed driver input */
long bench_run(void) {
  odometry(100, 120, 8000, 1200);
  odometry(-50, 900, -700, 8100);
  odometry(300, -1000, 20, -8190);
  return x_um * 3 + y_um + heading;
}
