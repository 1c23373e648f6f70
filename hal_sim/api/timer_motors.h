/* SPDX-License-Identifier: MIT
 * Motors of the variants with timers of their own; DRIVER says which: 0 timers 5 and 4, 1 timer 3. Included
 * once a variant, after its e_motors.h. Steps and coils are evaluated by the board
 * (hal_sim/board/timer_motors.h).
 */
#include "hal_sim/host/pins.h"
#include "motor_led/e_init_port.h"

#define LEFT 0
#define RIGHT 1

/* what the motor's own count was when the counter stood at 0 */
static tp_i64 left_zero;
static tp_i64 right_zero;

void e_set_speed_left(int motor_speed) { tp_timer_motor_speed(DRIVER, LEFT, motor_speed); }

void e_set_speed_right(int motor_speed) { tp_timer_motor_speed(DRIVER, RIGHT, motor_speed); }

int e_get_steps_left(void) { return (int)(tp_timer_motor_steps(DRIVER, LEFT) - left_zero); }

int e_get_steps_right(void) { return (int)(tp_timer_motor_steps(DRIVER, RIGHT) - right_zero); }

void e_set_steps_left(int set_steps) { left_zero = tp_timer_motor_steps(DRIVER, LEFT) - set_steps; }

void e_set_steps_right(int set_steps) { right_zero = tp_timer_motor_steps(DRIVER, RIGHT) - set_steps; }
