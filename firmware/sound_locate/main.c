/* SPDX-License-Identifier: MIT
 * Turns towards whoever claps, drives a little, and so on until something stands in front.
 *
 * Direction: the three microphones hear the same clap a few samples apart. Cross-correlation tells how many, to a
 * fraction of a sample; two of the differences make the direction (a source that is far away compared with 6 cm).
 *
 *     left 1 (8, 31)          t0 - t1             = 62 mm sin(angle) / c       angle counter-clockwise from ahead
 *     right 0 (8, -31)        t2 - (t0 + t1) / 2  = 30 mm cos(angle) / c
 *     back 2 (-22, 0)
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <math.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>

#define LOUD 150            /* counts from lowest to highest: a clap */
#define LAGS 7              /* samples either way: 62 mm are 5.9 at 32768 Hz */
#define SIDE_MM 62.0f       /* between right and left */
#define DEPTH_MM 30.0f      /* from the back to the middle of these two */
#define SAMPLE_MM 10.467f   /* way of sound in one sample: 343 m/s / 32768 Hz */
#define CHANNEL_SKEW (1.0f / 3) /* samples by which each microphone is converted after the one before */
#define STEPS_PER_RAD 206.0f    /* one wheel, turning on the spot: 26.5 mm / 0.1288 mm */
#define SPEED 400
#define WAY_STEPS 470       /* 6 cm after each clap */
#define AHEAD 0.4f          /* rad: drives only when the clap came from about ahead */
#define NEAR 150            /* e_get_prox of a sensor in front: 3 cm */

extern int e_mic_scan[3][MIC_SAMP_NB];
extern unsigned int e_last_mic_scan_id;
void e_get_micro_last_values(int micro_id, int *result, unsigned samples_nb);

static int sound[3][MIC_SAMP_NB];

static void wait_for_a_buffer(void) {
  while (e_ad_is_array_filled());
  while (!e_ad_is_array_filled());
}

/* waits for a clap; leaves 3 ms of it in `sound`, mean taken off */
static void listen(void) {
  int m, i, mean;
  e_init_ad_scan(MICRO_ONLY);
  wait_for_a_buffer(); /* the buffers still hold the last clap */
  do
    wait_for_a_buffer();
  while (e_get_micro_volume(0) < LOUD);
  wait_for_a_buffer(); /* the clap may have begun in the middle of that one */
  e_ad_scan_off();
  for (m = 0; m < 3; m++) {
    e_get_micro_last_values(m, sound[m], MIC_SAMP_NB); /* newest first */
    mean = e_get_micro_average(m, MIC_SAMP_NB);
    for (i = 0; i < MIC_SAMP_NB; i++) sound[m][i] -= mean;
  }
}

static long correlation(const int *a, const int *b, int lag) {
  long sum = 0;
  int i;
  for (i = LAGS; i < MIC_SAMP_NB - LAGS; i++) sum += (long)a[i] * b[i + lag];
  return sum;
}

/* samples by which microphone a hears later than b (time runs backwards in `sound`) */
static float later(int a, int b) {
  long sum[2 * LAGS + 1];
  int lag, best = 1;
  float left, middle, right, bend;
  for (lag = 0; lag <= 2 * LAGS; lag++) sum[lag] = correlation(sound[a], sound[b], lag - LAGS);
  for (lag = 1; lag < 2 * LAGS; lag++)
    if (sum[lag] > sum[best]) best = lag;
  /* the peak of the parabola through the highest value and its neighbours */
  left = sum[best - 1];
  middle = sum[best];
  right = sum[best + 1];
  bend = left - 2 * middle + right;
  return best - LAGS + (bend < 0 ? 0.5f * (left - right) / bend : 0) + (a - b) * CHANNEL_SKEW;
}

static float direction(void) {
  float side = later(0, 1), depth = (later(2, 0) + later(2, 1)) / 2;
  return atan2f(side * SAMPLE_MM / SIDE_MM, depth * SAMPLE_MM / DEPTH_MM);
}

static void turn(float angle) {
  int steps = (int)(angle * STEPS_PER_RAD);
  int speed = steps > 0 ? SPEED : -SPEED;
  if (steps < 0) steps = -steps;
  e_set_steps_left(0);
  e_set_steps_right(0);
  e_set_speed_left(-speed);
  e_set_speed_right(speed);
  while (e_get_steps_right() < steps && e_get_steps_right() > -steps);
  e_set_speed_left(0);
  e_set_speed_right(0);
}

static int is_near(void) { return e_get_prox(0) > NEAR || e_get_prox(7) > NEAR; }

/* a little way ahead; 1 when something is in front */
static int drive(void) {
  int near = 0;
  e_init_ad_scan(ALL_ADC);
  e_set_steps_left(0);
  e_set_speed_left(SPEED);
  e_set_speed_right(SPEED);
  while (e_get_steps_left() < WAY_STEPS && !near) near = is_near();
  e_set_speed_left(0);
  e_set_speed_right(0);
  e_ad_scan_off();
  return near;
}

int main(void) {
  int found = 0;
  e_init_port();
  e_init_motors();
  e_start_agendas_processing();
  while (!found) {
    float angle;
    listen();
    angle = direction();
    e_set_body_led(1);
    turn(angle);
    if (angle < AHEAD && angle > -AHEAD) found = drive();
    e_set_body_led(0);
  }
  e_set_front_led(1);
  while (1);
}
