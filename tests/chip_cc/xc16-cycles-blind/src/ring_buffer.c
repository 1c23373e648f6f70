// SPDX-License-Identifier: MIT
/* ring_buffer: bytes in and out of a ring of sixteen. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static unsigned char ring[16];
static unsigned char head, tail;
static int overruns;
NOINLINE int ring_buffer(int byte) {
  if (byte >= 0) {
    unsigned char next = (unsigned char)((head + 1) & 15);
    if (next == tail) {
      overruns++;
      return 0;
    }
    ring[head] = (unsigned char)byte;
    head = next;
    return 1;
  }
  if (head == tail) return -1;
  byte = ring[tail];
  tail = (unsigned char)((tail + 1) & 15);
  return byte;
}

/* fixed driver input */
long bench_run(void) {
  long sum = 0;
  int i;
  for (i = 0; i < 18; i++) sum += ring_buffer(i * 3);
  for (i = 0; i < 5; i++) sum = sum * 2 + ring_buffer(-1);
  return sum + overruns;
}
