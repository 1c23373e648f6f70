/* SPDX-License-Identifier: MIT
 * Motors, basic variant: Timer 5 left, Timer 4 right. Source: [lib: motor_led/e_motors.c], facts restated.
 */
#include "motor_led/e_motors.h"

#define DRIVER 0
#include "timer_motors.h"

void e_init_motors(void) { e_init_port(); }
