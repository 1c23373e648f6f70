// SPDX-License-Identifier: MIT
/* float_nearest: nearest of several points. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const float px[4] = {0.5f, 2.0f, -1.0f, 0.25f}, py[4] = {0.5f, -1.0f, 1.5f, 3.0f};
NOINLINE int float_nearest(float x, float y) {
  float least = 1.0e9f;
  int i, best = -1;
  for (i = 0; i < 4; i++) {
    float dx = px[i] - x, dy = py[i] - y, d = dx * dx + dy * dy;
    if (d < least) {
      least = d;
      best = i;
    }
  }
  return best;
}

/* fixed driver input */
long bench_run(void) { return float_nearest(1.5f, -0.5f) * 10 + float_nearest(-0.5f, 2.0f); }
