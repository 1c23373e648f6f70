// SPDX-License-Identifier: MIT
/* grey_row: grey of three colours a pixel, weights in 256ths. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static unsigned char rgb[18] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 10, 20, 30, 200, 200, 200, 90, 7, 1};
static unsigned char grey[6];
NOINLINE void grey_row(unsigned char* out, const unsigned char* in, int n) {
  int i;
  for (i = 0; i < n; i++) {
    unsigned int sum = 77u * in[0] + 150u * in[1] + 29u * in[2];
    out[i] = (unsigned char)(sum >> 8);
    in += 3;
  }
}

/* fixed driver input */
long bench_run(void) {
  int i;
  long sum = 0;
  grey_row(grey, rgb, 6);
  for (i = 0; i < 6; i++) sum = sum * 5 + grey[i];
  return sum;
}
