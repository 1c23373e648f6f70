// SPDX-License-Identifier: MIT
/* reverse_text: turns a text round in place. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static char word[16] = "e-puck robot";
NOINLINE void reverse_text(char* s) {
  char* end = s;
  while (*end) end++;
  end--;
  while (s < end) {
    char t = *s;
    *s++ = *end;
    *end-- = t;
  }
}

/* fixed driver input */
long bench_run(void) {
  reverse_text(word);
  return word[0] * 3L + word[5] + word[11];
}
