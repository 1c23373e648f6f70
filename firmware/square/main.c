/* SPDX-License-Identifier: MIT
 * Square: dead reckoning. Sides and turns are counted in motor steps, so the robot comes back to where it started,
 * as exactly as its wheels roll without slipping.
 *
 * One step moves a wheel's rim by 0.1288 mm (41 mm wheel, 1000 steps a turn). Turning on the spot, each wheel runs on
 * a circle of 53 mm: a quarter turn is 53 x pi / 4 / 0.1288 = 323 steps.
 */
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>

#define SPEED 400         /* steps/s */
#define SIDE 1553         /* steps: 200 mm */
#define QUARTER_TURN 323  /* steps of each wheel */
#define SIDES 4

/* Runs both wheels, at +-SPEED each, until the left one has made `steps` steps. */
static void run(int left_speed, int right_speed, int steps) {
  e_set_steps_left(0);
  e_set_speed_left(left_speed);
  e_set_speed_right(right_speed);
  while (e_get_steps_left() < steps && e_get_steps_left() > -steps);
  e_set_speed_left(0);
  e_set_speed_right(0);
}

int main(void) {
  int side;
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();

  for (side = 0; side < SIDES; side++) {
    e_set_led(2 * side, 1);
    run(SPEED, SPEED, SIDE);
    run(-SPEED, SPEED, QUARTER_TURN); /* to the left */
  }
  e_set_body_led(1);
  while (1);
}
