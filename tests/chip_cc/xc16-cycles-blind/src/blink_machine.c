// SPDX-License-Identifier: MIT
/* blink_machine: four states with counters, one step a call. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

enum state { WAITING, ON, FADING, OFF };
static enum state now = WAITING;
static int counter, led;
NOINLINE void blink_machine(int button) {
  switch (now) {
    case WAITING:
      if (button) {
        now = ON;
        counter = 3;
        led = 8;
      }
      break;
    case ON:
      if (--counter == 0) now = FADING;
      break;
    case FADING:
      led--;
      if (led <= 4) now = OFF;
      break;
    default:
      led = 0;
      if (!button) now = WAITING;
      break;
  }
}

/* fixed driver input */
long bench_run(void) {
  int i;
  long sum = 0;
  for (i = 0; i < 14; i++) {
    blink_machine(i == 2 || i > 10);
    sum = sum * 3 + led + now;
  }
  return sum;
}
