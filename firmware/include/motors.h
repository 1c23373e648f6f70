/* SPDX-License-Identifier: MIT
 * Stepper motors on timers 4 and 5, as the library named them before 2006. Behaviour, units and quirks are
 * those of motor_led/e_motors.h; the guard is shared with it.
 */
#ifndef _MOTORS
#define _MOTORS

#include "twinpuck.h"

/** Initialises the ports. */
void InitMotors(void);

/** Speed in steps/s, positive forward, 0 stops; does not block. */
void SetSpeedLeft(int motor_speed);
void SetSpeedRight(int motor_speed);

/** Step counters, 16 bits, wrap after +-32767. */
int GetStepsLeft(void);
int GetStepsRight(void);
void SetStepsLeft(int set_steps);
void SetStepsRight(int set_steps);

#endif
