/* SPDX-License-Identifier: MIT
 * U obstacle: gets out of corridors with a dead end.
 *
 * Along a corridor it keeps to the middle, steering by the difference of its two sides. A wall ahead makes it turn
 * about by half a turn, counted in motor steps, whatever its sensors say meanwhile: between two near walls no direction
 * looks free. Other obstacles it goes around with turns of a random size, so that no cycle lasts.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <stdlib.h>

#define CONTROL_PERIOD 320 /* agenda ticks of 0.1 ms */
#define CRUISE 450         /* steps/s */
#define SPIN 350           /* steps/s */
#define STEER_LIMIT 300    /* steps/s */

#define AHEAD 150       /* counts, mean of the two front sensors: about 42 mm to a white wall */
#define BESIDE 80       /* counts: something stands on this side */
#define HALF_TURN 646   /* motor steps of each wheel for 180 degrees on the spot */
#define QUARTER_TURN 323

static volatile int control_due;
static int steps_to_turn; /* still to turn; 0: driving */

static void control_tick(void) { control_due = 1; }

/* Sets both speeds, but only when they change: repeating a speed disturbs the motor driver's power save. */
static void drive(int left, int right) {
  static int last_left, last_right;
  if (left == last_left && right == last_right) return;
  last_left = left;
  last_right = right;
  e_set_speed_left(left);
  e_set_speed_right(right);
}

static int larger(int a, int b) { return a > b ? a : b; }

/* A turn on the spot by so many motor steps, away from the nearer side. */
static void begin_turn(int steps, int left, int right) {
  steps_to_turn = steps;
  if (left > right)
    drive(SPIN, -SPIN);
  else
    drive(-SPIN, SPIN);
}

static void control(void) {
  int right = larger(e_get_prox(1), e_get_prox(2));
  int left = larger(e_get_prox(6), e_get_prox(5));
  int steer;

  if (steps_to_turn > 0) {
    /* SPIN steps a second, a period of 32 ms */
    steps_to_turn -= (int)((long)SPIN * CONTROL_PERIOD / 10000);
    return;
  }
  if ((e_get_prox(0) + e_get_prox(7)) / 2 > AHEAD) {
    int is_corridor = left > BESIDE && right > BESIDE;
    begin_turn(is_corridor ? HALF_TURN : QUARTER_TURN / 2 + rand() % QUARTER_TURN, left, right);
    return;
  }
  steer = left - right; /* a count of difference is worth a step/s */
  if (steer > STEER_LIMIT) steer = STEER_LIMIT;
  if (steer < -STEER_LIMIT) steer = -STEER_LIMIT;
  drive(CRUISE + steer, CRUISE - steer);
}

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);

  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    while (!control_due);
    control_due = 0;
    control();
  }
}
