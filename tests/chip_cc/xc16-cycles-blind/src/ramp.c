// SPDX-License-Identifier: MIT
/* ramp: speeds that change by at most a step a call, two wheels. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

struct motor {
  int now, wanted, step;
};
static struct motor motors[2] = {{0, 500, 70}, {100, -300, 90}};
NOINLINE int ramp(struct motor* m, int n) {
  int moving = 0;
  for (; n > 0; n--, m++) {
    int d = m->wanted - m->now;
    if (d > m->step) d = m->step;
    if (d < -m->step) d = -m->step;
    m->now += d;
    if (d) moving++;
  }
  return moving;
}

/* fixed driver input */
long bench_run(void) {
  long sum = 0;
  int i;
  for (i = 0; i < 6; i++) sum = sum * 3 + ramp(motors, 2);
  return sum + motors[0].now * 7L + motors[1].now;
}
