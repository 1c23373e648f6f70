/* SPDX-License-Identifier: MIT
 * Stepper motors on the fast agendas. Prototypes and quantisation as in the advanced e_motors.h; the steps
 * run on a timer of their own. Nothing here blocks.
 * Shares its guard with the other two e_motors.h: the first one included decides which variant runs.
 */
#ifndef _MOTORS
#define _MOTORS

#include "../../../twinpuck.h"

/** Reserves a timer for the two motor tasks. Does not initialise ports. */
void e_init_motors(void) TP_VARIANT(tpfast_, e_init_motors);

/** Speed of one wheel, steps/s, -1000 to 1000, positive forward; larger values are limited; 0 stops it. */
void e_set_speed_left(int motor_speed) TP_VARIANT(tpfast_, e_set_speed_left);
void e_set_speed_right(int motor_speed) TP_VARIANT(tpfast_, e_set_speed_right);

/** left = linear - angular, right = linear + angular, steps/s; ignored when |linear| + |angular| > 1000. */
void e_set_speed(int linear_speed, int angular_speed) TP_VARIANT(tpfast_, e_set_speed);

/** Sets a step counter; the wheel does not care. */
void e_set_steps_left(int steps_left) TP_VARIANT(tpfast_, e_set_steps_left);
void e_set_steps_right(int steps_right) TP_VARIANT(tpfast_, e_set_steps_right);

/** Step counters, 16 bits, wrap after +-32767. The right one counts with a sign that differs from the other
 *  drivers, as in the original. */
int e_get_steps_left() TP_VARIANT(tpfast_, e_get_steps_left);
int e_get_steps_right() TP_VARIANT(tpfast_, e_get_steps_right);

#endif
