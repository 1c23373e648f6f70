/* SPDX-License-Identifier: MIT
 * Braiten: obstacle avoidance by a linear map from the eight proximity sensors to the two wheels. Each wheel's
 * speed is CRUISE plus a weighted sum of the readings; there is nothing else: no state, no rule, no threshold.
 *
 * The weights are Braitenberg's vehicle 3b, crossed inhibition, with excitation on the near side: what stands on
 * the right brakes the left wheel and drives the right one. Left and right are mirror images.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>

#define SENSORS 8
#define CONTROL_PERIOD 640 /* agenda ticks of 0.1 ms */
#define CRUISE 400         /* steps/s with nothing near */
#define LIMIT 900          /* steps/s, what the motors can do */

/* percent of a step/s for each count of a sensor; sensor 0 is front right, then clockwise */
static const int left_weight[SENSORS] = {-100, -100, -10, 0, 0, 10, 70, 0};
static const int right_weight[SENSORS] = {0, 70, 10, 0, 0, -10, -100, -100};

static volatile int control_due;

static void control_tick(void) { control_due = 1; }

static int limited(long speed) {
  if (speed > LIMIT) return LIMIT;
  if (speed < -LIMIT) return -LIMIT;
  return (int)speed;
}

static void control(void) {
  long left = 0, right = 0; /* long: 100 x 4095 does not fit 16 bits */
  int sensor;
  for (sensor = 0; sensor < SENSORS; sensor++) {
    int reading = e_get_prox(sensor);
    left += (long)left_weight[sensor] * reading;
    right += (long)right_weight[sensor] * reading;
  }
  e_set_speed_left(limited(CRUISE + left / 100));
  e_set_speed_right(limited(CRUISE + right / 100));
}

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);

  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    while (!control_due);
    control_due = 0;
    control();
  }
}
