/* SPDX-License-Identifier: MIT
 * Follow light: turns to the lamp that it sees and drives there, round what stands in the way.
 *
 * A sensor's ambient reading falls with light. What the darkest sensor reads is light from everywhere; each
 * sensor that reads less than that pulls the robot in its direction. The eight pulls together are an arrow:
 * forward and left parts. Right under a lamp no sensor sees it; the robot goes straight on until it does again,
 * and so stays around the lamp. LEDs show the pulls, the body LED that there is light to follow.
 */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>

#define SENSORS 8
#define CONTROL_PERIOD 500 /* agenda ticks of 0.1 ms: 20 times a second */
#define CRUISE 400         /* steps/s */
#define TURN 300           /* steps/s, at most, added to one wheel and taken from the other */
#define FAINT 8            /* counts: an arrow shorter than this is no light */
#define NEAR 150           /* counts of proximity, about 4 cm from a white wall */

/* directions of the sensors, in hundredths: front right, then clockwise */
static const int forward_part[SENSORS] = {96, 69, 0, -87, -87, 0, 69, 96};
static const int left_part[SENSORS] = {-29, -72, -100, -48, 48, 100, 72, 29};

static volatile int control_due;

static void control_tick(void) { control_due = 1; }

static void drive(int speed, int turn) {
  e_set_speed_left(speed - turn);
  e_set_speed_right(speed + turn);
}

/* turns away from an obstacle in front; 1 when there was one */
static int avoid(void) {
  int right = e_get_prox(0) + e_get_prox(1), left = e_get_prox(6) + e_get_prox(7);
  if (right < NEAR && left < NEAR) return 0;
  drive(CRUISE / 4, left > right ? -TURN : TURN);
  return 1;
}

static void follow(void) {
  long forward = 0, left = 0; /* long: 4095 x 100 does not fit 16 bits */
  long size;
  int reading[SENSORS], darkest = 0, sensor;
  for (sensor = 0; sensor < SENSORS; sensor++) {
    reading[sensor] = e_get_ambient_light(sensor);
    if (reading[sensor] > darkest) darkest = reading[sensor];
  }
  for (sensor = 0; sensor < SENSORS; sensor++) {
    int pull = darkest - reading[sensor];
    forward += (long)forward_part[sensor] * pull / 100;
    left += (long)left_part[sensor] * pull / 100;
    e_set_led(sensor, pull > FAINT);
  }
  size = (forward < 0 ? -forward : forward) + (left < 0 ? -left : left);
  e_set_body_led(size > FAINT);
  if (avoid()) return;
  if (size <= FAINT) {
    drive(CRUISE, 0);
  } else if (forward <= 0) { /* behind: on the spot */
    drive(0, left < 0 ? -TURN : TURN);
  } else {
    drive(CRUISE, (int)(TURN * left / size));
  }
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
    follow();
  }
}
