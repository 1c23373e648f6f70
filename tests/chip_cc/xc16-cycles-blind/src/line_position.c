// SPDX-License-Identifier: MIT
/* line_position: where a dark line lies under three ground sensors, in promille. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

NOINLINE int line_position(const int* ground) {
  long weighted = 0;
  int sum = 0, i;
  for (i = 0; i < 3; i++) {
    int dark = 1000 - ground[i];
    if (dark < 0) dark = 0;
    weighted += (long)dark * (i * 1000);
    sum += dark;
  }
  if (sum < 50) return -1;
  return (int)(weighted / sum);
}

/* fixed driver input */
static const int left[3] = {200, 800, 950}, nothing[3] = {990, 1001, 995}, right[3] = {900, 600, 100};
long bench_run(void) { return line_position(left) + 7L * line_position(nothing) + line_position(right); }
