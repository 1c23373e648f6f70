/* SPDX-License-Identifier: MIT
 * Motors, variant on Timer 3: a tick of 104.17 us, each wheel steps every 10000/|v| ticks.
 * Coils of a wheel with speed 0 are switched off at every tick.
 * Source: [lib: motor_led/e_motors_timer3.c], facts restated.
 */
#define E_MOTORS_TIMER3
#include "motor_led/e_motors.h"

#include "hal.h"
#include "motor_led/e_init_port.h"

#define LEFT 0
#define RIGHT 1
#define SPEED_UNIT 10000
#define MAX_SPEED 999
#define RESTING_TICKS 9999
#define TICK_COUNTS 5 /* of 256 cycles, less one: 0.1 ms is 5.76, truncated */
#define PRESCALE_256 3

struct wheel {
  volatile int speed;
  volatile int ticks_left; /* until the next step */
  volatile int steps;
  unsigned char phase;
};

static struct wheel left_wheel, right_wheel;

static int magnitude(int value) { return value < 0 ? -value : value; }

static void tick(struct wheel *w, int which, int count, int turn) {
  int speed = w->speed;
  if (speed == 0) {
    hal_coils(which, 0);
    return;
  }
  if (--w->ticks_left > 0) return;
  w->ticks_left = SPEED_UNIT / magnitude(speed);
  w->steps += count;
  w->phase = (unsigned char)(w->phase + turn) & 3;
  hal_coils(which, hal_phase_coils[w->phase]);
}

void __attribute__((__interrupt__, __auto_psv__)) _T3Interrupt(void) {
  IFS0bits.T3IF = 0;
  if (left_wheel.speed > 0)
    tick(&left_wheel, LEFT, 1, -1);
  else
    tick(&left_wheel, LEFT, -1, 1);
  if (right_wheel.speed < 0)
    tick(&right_wheel, RIGHT, -1, -1);
  else
    tick(&right_wheel, RIGHT, 1, 1);
}

void e_init_motors(void) {
  e_init_port();
  T3CON = 0;
  T3CONbits.TCKPS = PRESCALE_256;
  TMR3 = 0;
  PR3 = TICK_COUNTS;
  left_wheel.speed = right_wheel.speed = 0;
  IFS0bits.T3IF = 0;
  IEC0bits.T3IE = 1;
  T3CONbits.TON = 1;
}

static void set_speed(struct wheel *w, int speed) {
  if (speed > MAX_SPEED) speed = MAX_SPEED;
  if (speed < -MAX_SPEED) speed = -MAX_SPEED;
  /* the count first: a tick between the two stores finds one of the old speed's or a full one */
  w->ticks_left = speed == 0 ? RESTING_TICKS : SPEED_UNIT / magnitude(speed);
  w->speed = speed;
}

void e_set_speed_left(int motor_speed) { set_speed(&left_wheel, motor_speed); }

void e_set_speed_right(int motor_speed) { set_speed(&right_wheel, motor_speed); }

int e_get_steps_left(void) { return left_wheel.steps; }

int e_get_steps_right(void) { return right_wheel.steps; }

void e_set_steps_left(int set_steps) { left_wheel.steps = set_steps; }

void e_set_steps_right(int set_steps) { right_wheel.steps = set_steps; }
