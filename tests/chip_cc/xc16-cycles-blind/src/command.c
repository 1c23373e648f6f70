// SPDX-License-Identifier: MIT
/* command: a letter and two numbers from a serial line. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static int argument[2];
NOINLINE char command(const char* s) {
  char letter = *s++;
  int i;
  if (letter >= 'a' && letter <= 'z') letter = (char)(letter - 32);
  for (i = 0; i < 2; i++) {
    int sign = 1, v = 0;
    if (*s == ',') s++;
    if (*s == '-') {
      sign = -1;
      s++;
    }
    while (*s >= '0' && *s <= '9') v = 10 * v + *s++ - '0';
    argument[i] = sign * v;
  }
  return letter;
}

/* fixed driver input */
long bench_run(void) {
  long sum = command("d,120,-340\r");
  sum += argument[0] * 3L + argument[1];
  sum += command("L,1,0\r");
  return sum + argument[0];
}
