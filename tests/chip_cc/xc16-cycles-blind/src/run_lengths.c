// SPDX-License-Identifier: MIT
/* run_lengths: lengths of equal runs of bytes. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static const char message[20] = "aaaabbbcdddddddddee";
static char packed[24];
NOINLINE int run_lengths(const char* in, char* out) {
  int used = 0;
  while (*in) {
    char c = *in;
    int n = 0;
    while (*in == c && n < 9) {
      in++;
      n++;
    }
    out[used++] = c;
    out[used++] = (char)('0' + n);
  }
  out[used] = 0;
  return used;
}

/* fixed driver input */
long bench_run(void) {
  int n = run_lengths(message, packed);
  return n * 1000L + packed[1] + packed[7] * 3 + packed[n - 1];
}
