/* SPDX-License-Identifier: MIT
 * Braitenberg's vehicle 3a, "love": two eyes, two motors, each eye brakes the motor of its own side.
 * The wheel nearer to the light runs slower, so it turns to the light, and stops where it is bright
 * enough.
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
#define FAST 500           /* steps/s in the dark */
#define LEAST 20           /* steps/s: a slower command is none */

static volatile int control_due;

static void control_tick(void) { control_due = 1; }

/* counts of light, the mean of three sensors */
static int eye(int front, int slanting, int side) {
  return DARK -
         (e_get_ambient_light(front) + e_get_ambient_light(slanting) + e_get_ambient_light(side)) / 3;
}

/* the more light, the slower; steps/s */
static int motor(int light) {
  int speed = FAST - light;
  return speed < LEAST ? 0 : speed;
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
    e_set_speed_left(motor(left));
    e_set_speed_right(motor(right));
  }
}
