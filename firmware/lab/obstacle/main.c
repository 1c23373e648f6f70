/* SPDX-License-Identifier: MIT
 * Obstacle: wanders through a maze without touching it.
 *
 * Forward it swings its nose to both sides, because the two front sensors look 17 degrees outwards and would miss
 * the end of a wall dead ahead. When something comes near it turns on the spot, away from the nearer side, until the
 * way is free: a round robot that turns on the spot touches nothing. It turns some more then, because an edge
 * that has just left one ray may stand in the gap of 28 degrees before the next.
 *
 * In a dead end no way is as free as it would like. Two things get it out: a turn that follows soon upon the last one
 * goes on the same way round, and the longer it has turned, the less it asks for.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>

#define CONTROL_PERIOD 320 /* agenda ticks of 0.1 ms */
#define CRUISE 480         /* steps/s */
#define SWING 250          /* steps/s added to one wheel and taken from the other */
#define SWING_PERIODS 10   /* control periods to one side */
#define SPIN 300           /* steps/s: 83 degrees a second */
#define FREE_PERIODS 11    /* control periods the way must be free before a turn ends: 29 degrees */
#define PATIENCE 16        /* control periods of turning after which it asks for one free period less */
#define MEMORY 60          /* control periods forward after which a turn is a new one */

#define FRONT_NEAR 130 /* counts: about 45 mm, white wall */
#define FRONT_FREE 110
#define SIDE_NEAR 250 /* oblique sensors: about 30 mm */
#define SIDE_FREE 200

enum { FORWARD, TURN_LEFT, TURN_RIGHT };

static volatile int control_due;

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

/* How close the robot is to something on one side: 100 = at the limit. */
static int closeness(int front, int front_limit, int side, int side_limit) {
  long nearest_front = 100L * e_get_prox(front) / front_limit;
  long nearest_side = 100L * e_get_prox(side) / side_limit;
  return (int)(nearest_front > nearest_side ? nearest_front : nearest_side);
}

static void control(void) {
  static int state = FORWARD, turn = TURN_LEFT;
  static int swing_phase, forward_periods = MEMORY, turn_periods, free_periods;
  int front_limit = state == FORWARD ? FRONT_NEAR : FRONT_FREE;
  int side_limit = state == FORWARD ? SIDE_NEAR : SIDE_FREE;
  int right = closeness(0, front_limit, 1, side_limit);
  int left = closeness(7, front_limit, 6, side_limit);

  /* once begun, a turn keeps its direction: in a corner the nearer side changes all the time */
  if (left >= 100 || right >= 100) {
    free_periods = 0;
    if (state == FORWARD && forward_periods >= MEMORY) {
      turn = left > right ? TURN_RIGHT : TURN_LEFT;
      turn_periods = 0;
    }
    state = turn;
  } else if (state != FORWARD && ++free_periods > FREE_PERIODS - turn_periods / PATIENCE) {
    state = FORWARD;
    forward_periods = 0;
  }

  if (state == FORWARD) {
    if (forward_periods < MEMORY) forward_periods++;
  } else {
    turn_periods++;
  }

  if (state == TURN_LEFT) {
    drive(-SPIN, SPIN);
  } else if (state == TURN_RIGHT) {
    drive(SPIN, -SPIN);
  } else {
    swing_phase = (swing_phase + 1) % (2 * SWING_PERIODS);
    if (swing_phase < SWING_PERIODS)
      drive(CRUISE + SWING, CRUISE - SWING);
    else
      drive(CRUISE - SWING, CRUISE + SWING);
  }
  e_set_led(0, state == FORWARD);
  e_set_led(6, state == TURN_LEFT);
  e_set_led(2, state == TURN_RIGHT);
}

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_uart1();
  e_init_ad_scan(ALL_ADC);

  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    while (!control_due);
    control_due = 0;
    control();
  }
}
