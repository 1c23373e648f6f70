// SPDX-License-Identifier: MIT
/* debounce: a button counts as pressed after four equal samples. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static unsigned char history, stable;
NOINLINE unsigned char debounce(unsigned char raw) {
  history = (unsigned char)((history << 1) | (raw & 1));
  if ((history & 0x0f) == 0x0f)
    stable = 1;
  else if ((history & 0x0f) == 0)
    stable = 0;
  return stable;
}

/* fixed driver input */
long bench_run(void) {
  static const unsigned char raw[12] = {0, 1, 0, 1, 1, 1, 1, 0, 1, 0, 0, 0};
  long bits = 0;
  int i;
  for (i = 0; i < 12; i++) bits = bits * 2 + debounce(raw[i]);
  return bits;
}
