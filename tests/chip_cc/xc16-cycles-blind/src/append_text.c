// SPDX-License-Identifier: MIT
/* append_text: copies a text behind another one, within a limit. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static char buffer[24] = "left ";
NOINLINE int append_text(char* to, const char* from, int most) {
  int n = 0;
  while (to[n]) n++;
  while (*from && n < most - 1) to[n++] = *from++;
  to[n] = '\0';
  return n;
}

/* fixed driver input */
long bench_run(void) {
  int a = append_text(buffer, "and right", 24);
  return a * 100 + append_text(buffer, " and behind", 24);
}
