// SPDX-License-Identifier: MIT
/* pack_bits: eight flags into a byte and back, counted. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const unsigned char flags[8] = {1, 0, 1, 1, 0, 0, 1, 0};
NOINLINE int pack_bits(const unsigned char* in) {
  unsigned char packed = 0;
  int i, set = 0;
  for (i = 0; i < 8; i++)
    if (in[i]) packed |= (unsigned char)(1 << i);
  for (i = 7; i >= 0; i--)
    if (packed & (1 << i)) set += i;
  return packed * 32 + set;
}

/* fixed driver input */
long bench_run(void) { return pack_bits(flags); }
