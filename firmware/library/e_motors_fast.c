/* SPDX-License-Identifier: MIT
 * Motors on the fast agenda. Every step is an event here; the motor follows the coils.
 * Kept from the original: the right wheel's cycle is set through the general list, and its counter runs the
 * other way.
 * Source: [lib: motor_led/advance_one_timer/fast_agenda/e_motors.c], facts restated.
 */
#include "motor_led/advance_one_timer/fast_agenda/e_motors.h"

#include "hal.h"
#include "motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h"

#define LEFT 0
#define RIGHT 1
#define SPEED_UNIT 10000     /* units of 0.1 ms times steps/s */
#define POWER_SAVE_SPEED 650 /* TRESHV */
#define POWER_SAVE_BELOW 601 /* MAXV */
#define MAX_SPEED 1000

struct wheel {
  int speed;
  int steps;
  signed char phase;
  char phase_on;
};

static struct wheel left, right;
static const unsigned char coils[4] = {0xA, 0x6, 0x5, 0x9}; /* bit 0 = A */

static int magnitude(int value) { return value < 0 ? -value : value; }

/* one firing: a step, or in power save the coils off. Returns the cycle it asks for, -1 for none. */
static int fire(struct wheel *w, int which, int count, int turn) {
  if (w->phase_on && magnitude(w->speed) < POWER_SAVE_BELOW) {
    hal_coils(which, 0);
    w->phase_on = 0;
    return SPEED_UNIT / magnitude(w->speed) - SPEED_UNIT / POWER_SAVE_SPEED;
  }
  w->steps += count;
  w->phase = (w->phase + turn) & 3;
  hal_coils(which, coils[w->phase]);
  if (magnitude(w->speed) >= POWER_SAVE_BELOW) return -1;
  w->phase_on = 1;
  return SPEED_UNIT / POWER_SAVE_SPEED;
}

static void run_left(void) {
  int cycle = left.speed > 0 ? fire(&left, LEFT, 1, -1) : fire(&left, LEFT, -1, 1);
  if (cycle >= 0) e_set_motor_speed(run_left, cycle);
}

static void run_right(void) {
  char was_off_half = right.phase_on && magnitude(right.speed) < POWER_SAVE_BELOW;
  int cycle = right.speed < 0 ? fire(&right, RIGHT, 1, -1) : fire(&right, RIGHT, -1, 1);
  if (cycle < 0) return;
  if (was_off_half)
    e_set_motor_speed(run_right, cycle);
  else
    e_set_agenda_cycle(run_right, cycle);
}

void e_init_motors(void) { e_activate_motors(run_left, run_right); }

static int limited(int speed) {
  return speed > MAX_SPEED ? MAX_SPEED : speed < -MAX_SPEED ? -MAX_SPEED : speed;
}

void e_set_speed_left(int motor_speed) {
  hal_coils(LEFT, 0);
  left.speed = limited(motor_speed);
  e_set_motor_speed(run_left, left.speed == 0 ? 0 : SPEED_UNIT / magnitude(left.speed));
}

void e_set_speed_right(int motor_speed) {
  hal_coils(RIGHT, 0);
  right.speed = limited(motor_speed);
  e_set_agenda_cycle(run_right, right.speed == 0 ? 0 : SPEED_UNIT / magnitude(right.speed));
}

void e_set_speed(int linear_speed, int angular_speed) {
  if (magnitude(linear_speed) + magnitude(angular_speed) > MAX_SPEED) return;
  e_set_speed_left(linear_speed - angular_speed);
  e_set_speed_right(linear_speed + angular_speed);
}

int e_get_steps_left() { return left.steps; }

int e_get_steps_right() { return right.steps; }

void e_set_steps_left(int steps_left) { left.steps = steps_left; }

void e_set_steps_right(int steps_right) { right.steps = steps_right; }
