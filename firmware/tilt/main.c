/* SPDX-License-Identifier: MIT
 * Climbs: drives straight on until the floor rises, steers to where it rises most, and stops where it is level
 * again. The ring shows the lowest side all the time. Selector 1: stands still and only shows.
 */
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
#include <stdlib.h>
#include <utility/utility.h>

#define SHOW_ONLY 1     /* selector position */
#define PERIOD 500      /* agenda ticks of 0.1 ms between control steps: 50 ms */
#define ONE_SAMPLE 10000L /* of wait(): more than the 4 ms from sample to sample */
#define SPEED 300       /* steps per second; 1000 steps are 129 mm */
#define MOST_TURN 200   /* difference of each wheel to SPEED, steps per second */
#define STEEP 60        /* counts across the vertical: 4.5 degrees at 768 counts per g */
#define LEVEL 25        /* counts: 1.9 degrees */
#define LEVEL_STEPS 25  /* control steps on the level before it stops: 5 cm further on */

void wait(long num); /* utility.c has it, utility.h has not */

enum { SEARCHING, CLIMBING, ARRIVED };

static volatile char due;
static int state = SEARCHING;
static int level_steps;

static void step(void) { due = 1; }

static void drive(int speed, int turn) {
  e_set_speed_left(speed - turn);
  e_set_speed_right(speed + turn);
}

static int clamp(int value, int most) {
  if (value > most) return most;
  return value < -most ? -most : value;
}

static void climb(void) {
  TypeAccRaw acc = e_read_acc_xyz();
  int tilt = abs(acc.acc_x) > abs(acc.acc_y) ? abs(acc.acc_x) : abs(acc.acc_y);

  switch (state) {
    case SEARCHING:
      drive(SPEED, 0);
      if (tilt > STEEP) state = CLIMBING;
      break;
    case CLIMBING:
      /* x > 0: the left side is higher, so uphill is on the left; y < 0: the nose points downhill */
      if (acc.acc_y < 0 && tilt > LEVEL)
        drive(0, acc.acc_x > 0 ? MOST_TURN : -MOST_TURN);
      else
        drive(SPEED, tilt > LEVEL ? clamp(2 * acc.acc_x, MOST_TURN) : 0);
      level_steps = tilt > LEVEL ? 0 : level_steps + 1;
      if (level_steps < LEVEL_STEPS) break;
      state = ARRIVED;
      drive(0, 0);
      e_set_body_led(1);
      break;
    case ARRIVED:
      break;
  }
}

int main(void) {
  e_init_port();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  wait(ONE_SAMPLE); /* e_init_ad_scan() returns one sample before the buffer that is calibrated with is full */
  e_acc_calibr();   /* the robot stands on the level now */
  e_start_agendas_processing();
  e_activate_agenda(step, PERIOD);
  while (1) {
    while (!due);
    due = 0;
    e_display_angle();
    if (getselector() != SHOW_ONLY) climb();
  }
}
