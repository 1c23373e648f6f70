// SPDX-License-Identifier: MIT
/* count_words: words between blanks. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

NOINLINE int count_words(const char* s) {
  int words = 0, inside = 0;
  for (; *s; s++) {
    if (*s == ' ' || *s == '\t' || *s == '\n') {
      inside = 0;
    } else if (!inside) {
      inside = 1;
      words++;
    }
  }
  return words;
}

/* fixed driver input */
long bench_run(void) { return count_words("set speed  100 200\n") * 10 + count_words("   "); }
