/* SPDX-License-Identifier: MIT
 * Motors on agendas, usual variant. Below 601 steps/s each step is split to save power: coils on for 15 ticks, off for
 * the rest of the step; each half sets the agenda's cycle for the next one.
 * Kept from the original: setting a speed switches the coils off and overwrites the half's cycle, so a speed set all
 * the time stretches both halves. Not kept: the tick that could fall between storing speed 0 and stopping the agenda
 * divided by zero there.
 * Source: [lib: motor_led/advance_one_timer/e_motors.c], facts restated.
 */
#include "motor_led/advance_one_timer/e_motors.h"

#include "hal.h"
#include "motor_led/advance_one_timer/e_agenda.h"

#define LEFT 0
#define RIGHT 1
#define SPEED_UNIT 10000     /* ticks of 0.1 ms times steps/s */
#define POWER_SAVE_SPEED 650 /* TRESHV */
#define POWER_SAVE_BELOW 601 /* MAXV */
#define MAX_SPEED 1000

struct wheel {
  volatile int speed; /* steps/s, limited */
  volatile int steps;
  unsigned char phase;
  char phase_on; /* power save: the next call switches the coils off */
};

static struct wheel left_wheel, right_wheel;

/* the agendas' functions; visible, since programs pause or re-time them */
void run_left_motor(void);
void run_right_motor(void);

/* the agenda whose callback runs (e_agenda.c) */
extern Agenda *volatile hal_running_agenda;

/* the next half's cycle; without a search when the motor's own agenda is the one that runs */
static void set_half(void (*self)(void), int cycle) {
  Agenda *agenda = hal_running_agenda;
  if (agenda && agenda->function == self)
    agenda->cycle = (unsigned int)cycle;
  else
    e_set_agenda_cycle(self, cycle);
}

static int magnitude(int value) { return value < 0 ? -value : value; }

static void fire(struct wheel *w, int which, int count, int turn, void (*self)(void)) {
  int speed = magnitude(w->speed);
  if (w->phase_on && speed < POWER_SAVE_BELOW) {
    hal_coils(which, 0);
    w->phase_on = 0;
    set_half(self, SPEED_UNIT / speed - SPEED_UNIT / POWER_SAVE_SPEED);
    return;
  }
  w->steps += count;
  w->phase = (unsigned char)(w->phase + turn) & 3;
  hal_coils(which, hal_phase_coils[w->phase]);
  if (speed >= POWER_SAVE_BELOW) return;
  w->phase_on = 1;
  set_half(self, SPEED_UNIT / POWER_SAVE_SPEED);
}

void run_left_motor(void) {
  if (left_wheel.speed > 0)
    fire(&left_wheel, LEFT, 1, -1, run_left_motor);
  else
    fire(&left_wheel, LEFT, -1, 1, run_left_motor);
}

void run_right_motor(void) {
  if (right_wheel.speed < 0)
    fire(&right_wheel, RIGHT, -1, -1, run_right_motor);
  else
    fire(&right_wheel, RIGHT, 1, 1, run_right_motor);
}

void e_init_motors(void) {
  e_activate_agenda(run_left_motor, 0);
  e_activate_agenda(run_right_motor, 0);
}

static void set_speed(struct wheel *w, int speed, void (*run)(void)) {
  if (speed > MAX_SPEED) speed = MAX_SPEED;
  if (speed < -MAX_SPEED) speed = -MAX_SPEED;
  if (speed == 0) {
    e_set_agenda_cycle(run, 0);
    w->speed = 0;
  } else {
    w->speed = speed;
    e_set_agenda_cycle(run, SPEED_UNIT / (speed < 0 ? -speed : speed));
  }
}

void e_set_speed_left(int motor_speed) {
  MOTOR1_PHA = 0;
  MOTOR1_PHB = 0;
  MOTOR1_PHC = 0;
  MOTOR1_PHD = 0;
  set_speed(&left_wheel, motor_speed, run_left_motor);
}

void e_set_speed_right(int motor_speed) {
  MOTOR2_PHA = 0;
  MOTOR2_PHB = 0;
  MOTOR2_PHC = 0;
  MOTOR2_PHD = 0;
  set_speed(&right_wheel, motor_speed, run_right_motor);
}

void e_set_speed(int linear_speed, int angular_speed) {
  /* magnitudes and sums wrap at 16 bits */
  unsigned int linear = linear_speed < 0 ? -(unsigned int)linear_speed : (unsigned int)linear_speed;
  unsigned int angular = angular_speed < 0 ? -(unsigned int)angular_speed : (unsigned int)angular_speed;
  if ((int)(linear + angular) > MAX_SPEED) return;
  e_set_speed_left((int)((unsigned int)linear_speed - (unsigned int)angular_speed));
  e_set_speed_right((int)((unsigned int)linear_speed + (unsigned int)angular_speed));
}

int e_get_steps_left() { return left_wheel.steps; }

int e_get_steps_right() { return right_wheel.steps; }

void e_set_steps_left(int steps_left) { left_wheel.steps = steps_left; }

void e_set_steps_right(int steps_right) { right_wheel.steps = steps_right; }
