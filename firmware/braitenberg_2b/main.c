/* SPDX-License-Identifier: MIT
 * Braitenberg's vehicle 2b, "aggression": two eyes, two motors, each eye drives the motor of the other side.
 * The wheel farther from the light runs faster, so it turns to the light and rushes at it.
 *
 * Each eye is the mean of three sensors on its side. A dark sample falls with light, from 4095 in the dark, so
 * an eye's light is what is missing from that.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>

#define DARK 4095          /* counts of a sensor that sees no light */
#define CONTROL_PERIOD 500 /* agenda ticks of 0.1 ms: 20 times a second */
#define SLOW 200           /* steps/s in the dark */
#define LIMIT 1000         /* steps/s, the fastest that the library drives */

static volatile int control_due;

static void control_tick(void) { control_due = 1; }

/* counts of light, the mean of three sensors */
static int eye(int front, int slanting, int side) {
  return DARK -
         (e_get_ambient_light(front) + e_get_ambient_light(slanting) + e_get_ambient_light(side)) / 3;
}

/* the more light, the faster; steps/s */
static int motor(int light) {
  int speed = SLOW + light;
  return speed > LIMIT ? LIMIT : speed;
}

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    int left, right;
    while (!control_due);
    control_due = 0;
    right = eye(0, 1, 2);
    left = eye(7, 6, 5);
    e_set_speed_left(motor(right));
    e_set_speed_right(motor(left));
  }
}
