/* SPDX-License-Identifier: MIT
 * Stepper motors, advanced variant (the usual one): both wheels are stepped by agendas on timer 2, so
 * e_start_agendas_processing() must have been called, before or after.
 *
 * 1000 steps turn a wheel once; one step moves the rim by 0.1288 mm; 500 steps/s are about 6.4 cm/s.
 *
 * Speeds are quantised: a step takes 10000/|v| agenda ticks (integer division) of 100.03 us, so 1000 and 950
 * both give 999.7 steps/s, 900 gives 908.8, 700 gives 714, 500 gives 500, 300 gives 303. Speeds are limited
 * to +-1000.
 *
 * Power save: below |v| = 601 the coils carry current for the first 15 ticks of a step only.
 * A consequence: a loop that sets the same speed again and again, faster than the wheel steps, stretches both
 * halves of the step and the wheel turns at about half speed. Set a speed when it changes, or a few times a
 * second.
 * Shares its guard with the basic e_motors.h: the first one included decides which variant runs.
 */
#ifndef _MOTORS
#define _MOTORS

#include "../../twinpuck.h"

/** Registers the two motor agendas. Does not initialise ports: call e_init_port() first. Does not block. */
void e_init_motors(void);

/** Speed of the left wheel, steps/s, -1000 to 1000, positive forward; larger values are limited. 0 stops the
 *  wheel and switches its coils off. Every call switches the wheel's coils off until the next half step. */
void e_set_speed_left(int motor_speed);

/** Speed of the right wheel; as e_set_speed_left(). */
void e_set_speed_right(int motor_speed);

/** Both wheels at once: left = linear - angular, right = linear + angular, steps/s; positive angular turns
 *  left. Ignored altogether when |linear| + |angular| is above 1000. */
void e_set_speed(int linear_speed, int angular_speed);

/** Sets a step counter; the wheel does not care. */
void e_set_steps_left(int steps_left);
void e_set_steps_right(int steps_right);

/** Steps since start or e_set_steps_*(): +1 for each step forward, -1 backward, 16 bits, wraps after +-32767
 *  (about 4.2 m). Do not block. */
int e_get_steps_left();
int e_get_steps_right();

#endif
