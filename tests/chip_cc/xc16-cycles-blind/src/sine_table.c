// SPDX-License-Identifier: MIT
/* sine_table: sine by a table of a quarter and linear interpolation. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const int quarter[17] = {0,   100, 200, 297, 392, 483,  569,  650, 724,
                                792, 851, 903, 946, 980, 1004, 1019, 1024};
NOINLINE int sine_table(unsigned int angle) {
  unsigned int part = angle & 0x3fff, index;
  int v;
  if (angle & 0x4000) part = 0x3fff - part;
  index = part >> 10;
  v = quarter[index] + (int)(((long)(quarter[index + 1] - quarter[index]) * (int)(part & 1023)) >> 10);
  return angle & 0x8000 ? -v : v;
}

/* fixed driver input */
long bench_run(void) { return sine_table(0x1234) + 3L * sine_table(0x6000) + 5L * sine_table(0xc123); }
