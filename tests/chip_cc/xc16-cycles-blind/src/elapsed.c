// SPDX-License-Identifier: MIT
/* elapsed: time since a moment, and whether it is over, in 32 bits. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static unsigned long started, clock_now;
NOINLINE int elapsed(unsigned long wait) {
  unsigned long passed = (clock_now - started) & 0xffffffffUL;
  if (passed >= wait) {
    started = clock_now;
    return 1;
  }
  return 0;
}

/* fixed driver input */
long bench_run(void) {
  int a, b, c;
  started = 0xfffffff0UL;
  clock_now = 0x00000100UL;
  a = elapsed(1000);
  b = elapsed(200);
  clock_now += 70000;
  c = elapsed(70000);
  return a + 2 * b + 4 * c + (long)(started & 0xffff);
}
