// SPDX-License-Identifier: MIT
/* fletcher16: Fletcher checksum with remainders. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

NOINLINE unsigned int fletcher16(const unsigned char* p, int n) {
  unsigned int a = 0, b = 0;
  while (n--) {
    a = (a + *p++) % 255;
    b = (b + a) % 255;
  }
  return b << 8 | a;
}

/* fixed driver input */
static const unsigned char frame[10] = {1, 200, 255, 17, 0, 64, 3, 3, 9, 250};
long bench_run(void) { return (long)fletcher16(frame, 10); }
