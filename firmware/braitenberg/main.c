/* SPDX-License-Identifier: MIT
 * Braitenberg: both wheel speeds are weighted sums of the eight proximity sensors. No states, no rules: what looks
 * like a decision is in the 8 x 2 matrix.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>

#define SENSORS 8
#define CONTROL_PERIOD 500 /* agenda ticks of 0.1 ms */
#define CRUISE 400         /* steps/s with nothing near */
#define LIMIT 800          /* steps/s */
#define FULL_READING 1000  /* counts that move a wheel by its whole weight: about 15 mm from a white wall */

/* steps/s that a full reading adds to each wheel; sensor 0 is front right, then clockwise */
static const int weight_left[SENSORS] = {-1000, -600, -200, 0, 0, 200, 600, 900};
static const int weight_right[SENSORS] = {900, 600, 200, 0, 0, -200, -600, -1000};

static volatile int control_due;

static void control_tick(void) { control_due = 1; }

static int limited(long speed) {
  if (speed > LIMIT) return LIMIT;
  if (speed < -LIMIT) return -LIMIT;
  return (int)speed;
}

static void control(void) {
  long left = CRUISE, right = CRUISE; /* long: 1000 x 4095 does not fit 16 bits */
  int sensor;
  for (sensor = 0; sensor < SENSORS; sensor++) {
    int reading = e_get_calibrated_prox(sensor);
    left += (long)weight_left[sensor] * reading / FULL_READING;
    right += (long)weight_right[sensor] * reading / FULL_READING;
    e_set_led(sensor, reading > FULL_READING / 4);
  }
  e_set_speed_left(limited(left));
  e_set_speed_right(limited(right));
}

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_uart1();
  e_init_ad_scan(ALL_ADC);
  e_calibrate_ir(); /* nothing should stand near the robot during this second */

  e_activate_agenda(control_tick, CONTROL_PERIOD);
  while (1) {
    while (!control_due);
    control_due = 0;
    control();
  }
}
