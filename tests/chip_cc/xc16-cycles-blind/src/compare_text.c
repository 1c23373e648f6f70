// SPDX-License-Identifier: MIT
/* compare_text: order of two texts. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

NOINLINE int compare_text(const char* a, const char* b) {
  while (*a && *a == *b) {
    a++;
    b++;
  }
  return *a - *b;
}

/* fixed driver input */
long bench_run(void) {
  return compare_text("forward", "fortune") + 3L * compare_text("stop", "stop") +
         100L * compare_text("turn", "turns");
}
