/* SPDX-License-Identifier: MIT
 * Stepper motors, basic variant: timer 5 steps the left wheel, timer 4 the right one, each at its own period,
 * in interrupts of priority 4. Cannot run together with the camera, which needs both timers.
 *
 * A third variant has the same prototypes and uses timer 3 for both wheels; define E_MOTORS_TIMER3 before
 * this header, or on the command line, to get it. Its tick is 104.17 us, speeds are limited to +-999 and
 * quantised to 9600/(10000/|v|) steps/s.
 *
 * 1000 steps turn a wheel once; one step moves the rim by 0.1288 mm; 500 steps/s are about 6.4 cm/s.
 * Shares its guard with the advanced e_motors.h: the first one included decides which variant runs.
 */
#ifndef _MOTORS
#define _MOTORS

#include "../twinpuck.h"

#ifdef E_MOTORS_TIMER3
#define TP_MOTORS(name) TP_VARIANT(tp_timer3_, name)
#else
#define TP_MOTORS(name) TP_VARIANT(tp_basic_, name)
#endif

/** Calls e_init_port(): LEDs off, motors without current; blocks as long as that does. */
void e_init_motors(void) TP_MOTORS(e_init_motors);

/** Speed of the left wheel, steps/s, positive forward; does not block.
 *  The timer's period is (57600/|v| + 1) x 17.36 us, so 1000 gives 993 steps/s and 100 gives 99.8; there is
 *  no limit, but the robot's motors stop following above about 1000. 0 stops the timer and switches the coils
 *  off. Each call restarts the period: a loop that sets the same speed faster than one period stops the
 *  wheel. -32768 has no absolute value in 16 bits and must not be used. */
void e_set_speed_left(int motor_speed) TP_MOTORS(e_set_speed_left);

/** Speed of the right wheel; as e_set_speed_left(). */
void e_set_speed_right(int motor_speed) TP_MOTORS(e_set_speed_right);

/** Steps of the left wheel since start or e_set_steps_left(): +1 for each step forward, -1 backward, 16 bits,
 *  wraps after +-32767 (about 4.2 m). Does not block. */
int e_get_steps_left(void) TP_MOTORS(e_get_steps_left);

/** Steps of the right wheel; as e_get_steps_left(). */
int e_get_steps_right(void) TP_MOTORS(e_get_steps_right);

/** Sets the left counter; the wheel does not care. */
void e_set_steps_left(int set_steps) TP_MOTORS(e_set_steps_left);

/** Sets the right counter; the wheel does not care. */
void e_set_steps_right(int set_steps) TP_MOTORS(e_set_steps_right);

#undef TP_MOTORS
#endif
