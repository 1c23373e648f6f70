/* SPDX-License-Identifier: MIT
 * Follow wall: finds a wall, then keeps it on its right at a constant distance, around inner and outer corners.
 *
 * The steering is proportional to the error of the side sensor; the front sensors overrule it.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>

#define CONTROL_PERIOD 640 /* agenda ticks of 0.1 ms */
#define CRUISE 350         /* steps/s */
#define SPIN 250           /* steps/s */
#define STEER_LIMIT 200    /* steps/s */

#define WANTED 350      /* counts of the two right-hand sensors, weighted: about 25 mm to a white wall */
#define FRONT_NEAR 180  /* counts: a wall ahead */
#define WALL_LOST 60    /* counts: nothing on the right */
#define GAIN 2          /* counts of error per step/s */

static volatile int control_due;

static void control_tick(void) { control_due = 1; }

/* Sets both speeds, but only when they change: repeating a speed disturbs the motor driver's power save. */
static void drive(int left, int right) {
  static int last_left, last_right;
  if (left == last_left && right == last_right) return;
  last_left = left;
  last_right = right;
  e_set_speed_left(left);
  e_set_speed_right(right);
}

static void control(void) {
  static int wall_found = 0;
  int front = e_get_prox(0) + e_get_prox(7);
  int oblique = e_get_prox(1);
  int side = (e_get_prox(2) + oblique) / 2; /* the oblique sensor sees ahead and keeps the robot parallel */
  int steer;

  if (front > FRONT_NEAR || e_get_prox(6) > FRONT_NEAR) {
    wall_found = 1;
    drive(-SPIN, SPIN); /* inner corner: turn left until the way is free */
  } else if (!wall_found && side < WANTED) {
    drive(CRUISE, CRUISE);
  } else {
    wall_found = 1;
    steer = (WANTED - side) / GAIN; /* positive: too far, turn right */
    if (steer > STEER_LIMIT) steer = STEER_LIMIT;
    if (steer < -STEER_LIMIT) steer = -STEER_LIMIT;
    drive(CRUISE + steer, CRUISE - steer);
  }
  e_set_led(2, wall_found && side > WALL_LOST);
  e_set_led(0, front > FRONT_NEAR);
}

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_uart1();
  e_init_ad_scan(ALL_ADC);

  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    while (!control_due);
    control_due = 0;
    control();
  }
}
