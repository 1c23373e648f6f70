/* SPDX-License-Identifier: MIT
 * Bench: the controller of the common benchmark (bench/), so that simulators run the same behaviour.
 *
 *   v_left  = 8 + 8 x sum(WL_i p_i) cm/s, v_right likewise, limited to +-12.8 cm/s, every 64 ms
 *   WL = (-1.3, -1, -0.5, 0, 0, 0.5, 1, 1.1),  WR = (1.1, 1, 0.5, 0, 0, -0.5, -1, -1.3)
 *   p = reading / 4095, from 0 (nothing) to 1 (contact)
 *
 * 1 cm/s is 10 / 0.1288 = 77.64 steps/s: 8 cm/s are 621 steps/s, 12.8 cm/s are 994.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>

#define SENSORS 8
#define CONTROL_PERIOD 640 /* agenda ticks of 0.1 ms: 64 ms */
#define CRUISE 621         /* steps/s */
#define LIMIT 994          /* steps/s */

/* tenths */
static const int weight_left[SENSORS] = {-13, -10, -5, 0, 0, 5, 10, 11};
static const int weight_right[SENSORS] = {11, 10, 5, 0, 0, -5, -10, -13};

static volatile int control_due;

static void control_tick(void) { control_due = 1; }

/* CRUISE x (1 + sum / (10 x 4095)), limited. |sum| <= 39 x 4095 fits a long, and so does CRUISE x sum. */
static int wheel_speed(long sum) {
  long speed = CRUISE + CRUISE * sum / 40950;
  if (speed > LIMIT) return LIMIT;
  if (speed < -LIMIT) return -LIMIT;
  return (int)speed;
}

static void control(void) {
  long left = 0, right = 0;
  int sensor;
  for (sensor = 0; sensor < SENSORS; sensor++) {
    int reading = e_get_prox(sensor);
    left += (long)weight_left[sensor] * reading;
    right += (long)weight_right[sensor] * reading;
  }
  e_set_speed_left(wheel_speed(left));
  e_set_speed_right(wheel_speed(right));
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
