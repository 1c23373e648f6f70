// SPDX-License-Identifier: MIT
/* float_steer: steering of a robot with floats and limits. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

static float integral;
NOINLINE int float_steer(int measured, int wanted) {
  float error = (float)(wanted - measured);
  float out;
  integral += error * 0.125f;
  if (integral > 100.0f)
    integral = 100.0f;
  else if (integral < -100.0f)
    integral = -100.0f;
  out = 2.0f * error + integral;
  if (out > 800.0f) out = 800.0f;
  return (int)out;
}

/* fixed driver input */
long bench_run(void) {
  long sum = float_steer(100, 500);
  sum = 3 * sum + float_steer(450, 500);
  return 3 * sum + float_steer(700, 500);
}
