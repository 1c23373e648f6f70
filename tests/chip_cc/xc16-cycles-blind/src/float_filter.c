// SPDX-License-Identifier: MIT
/* float_filter: exponential filter of floats over an array. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const float samples[6] = {1.0f, 4.0f, 2.5f, -3.0f, 0.5f, 8.0f};
NOINLINE float float_filter(const float* v, int n, float share) {
  float y = v[0];
  int i;
  for (i = 1; i < n; i++) y = y + share * (v[i] - y);
  return y;
}

/* fixed driver input */
long bench_run(void) { return (long)(float_filter(samples, 6, 0.25f) * 1024.0f); }
