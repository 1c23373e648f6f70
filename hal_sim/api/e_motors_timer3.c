/* SPDX-License-Identifier: MIT
 * Motors, variant on Timer 3. Source: [lib: motor_led/e_motors_timer3.c], facts restated.
 */
#define E_MOTORS_TIMER3
#include "motor_led/e_motors.h"

#define DRIVER 1
#include "timer_motors.h"

void e_init_motors(void) {
  e_init_port();
  tp_timer3_motors_start();
}
