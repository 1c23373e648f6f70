/* SPDX-License-Identifier: MIT
 * Motors on agendas, usual variant. Steps and coils are evaluated by the board
 * (hal_sim/board/agenda_motor.h).
 * Not modelled: the tick that may fall between storing speed 0 and stopping the agenda, which divides by
 * zero.
 * Source: [lib: motor_led/advance_one_timer/e_motors.c], facts restated.
 */
#include "motor_led/advance_one_timer/e_motors.h"

#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"
#include "motor_led/advance_one_timer/e_agenda.h"

#define LEFT 0
#define RIGHT 1
#define MAX_SUM 1000 /* steps/s, of e_set_speed() */

/* what the motor's own count was when the counter stood at 0 */
static tp_i64 left_zero;
static tp_i64 right_zero;

/* the agendas' functions; visible, since programs pause or re-time them */
void run_left_motor(void);
void run_right_motor(void);

void run_left_motor(void) { tp_motor_run(LEFT); }

void run_right_motor(void) { tp_motor_run(RIGHT); }

TAKES(T_INIT_MOTORS) void e_init_motors(void) {
  tp_motor_agenda(LEFT, (const void *)run_left_motor);
  tp_motor_agenda(RIGHT, (const void *)run_right_motor);
  e_activate_agenda(run_left_motor, 0);
  e_activate_agenda(run_right_motor, 0);
}

void e_set_speed_left(int motor_speed) { tp_motor_speed(LEFT, motor_speed); }

void e_set_speed_right(int motor_speed) { tp_motor_speed(RIGHT, motor_speed); }

void e_set_speed(int linear_speed, int angular_speed) {
  /* magnitudes and sums wrap at 16 bits, as on the robot */
  unsigned int linear = linear_speed < 0 ? -(unsigned int)linear_speed : (unsigned int)linear_speed;
  unsigned int angular = angular_speed < 0 ? -(unsigned int)angular_speed : (unsigned int)angular_speed;
  if ((int)(linear + angular) > MAX_SUM) return;
  e_set_speed_left((int)((unsigned int)linear_speed - (unsigned int)angular_speed));
  e_set_speed_right((int)((unsigned int)linear_speed + (unsigned int)angular_speed));
}

TAKES(T_GET_STEPS) int e_get_steps_left() { return (int)(tp_motor_steps(LEFT) - left_zero); }

TAKES(T_GET_STEPS) int e_get_steps_right() { return (int)(tp_motor_steps(RIGHT) - right_zero); }

TAKES(T_SET_STEPS) void e_set_steps_left(int steps_left) { left_zero = tp_motor_steps(LEFT) - steps_left; }

TAKES(T_SET_STEPS) void e_set_steps_right(int steps_right) { right_zero = tp_motor_steps(RIGHT) - steps_right; }
