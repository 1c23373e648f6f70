/* SPDX-License-Identifier: MIT
 * Line follow: keeps a dark line on a bright floor between the two outer ground sensors.
 *
 * The board answers over I2C at address 0xC0: registers 0 to 5 hold left, centre and right as two bytes each, the
 * high one first; dark is low. Steering is proportional to the difference of the outer two.
 */
#include <I2C/e_I2C_protocol.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>

#define GROUND 0xC0     /* I2C address */
#define SENSORS 3       /* left, centre, right */
#define ROUNDS 4        /* readings that are averaged: one round takes 3 ms */
#define DARK 600        /* counts: below it a sensor is over the line (white 850, black 370) */
#define CRUISE 400      /* steps/s */
#define STEER_LIMIT 380 /* steps/s */
#define SEARCH 250      /* steps/s, turning on the spot towards the side where the line was last */

/* public for the debugger and the test */
int ground[SENSORS]; /* counts, mean of ROUNDS readings */
int losses;          /* times that no sensor saw the line */

static void read_ground(void) {
  int round, i;
  for (i = 0; i < SENSORS; i++) ground[i] = 0;
  e_i2cp_enable();
  for (round = 0; round < ROUNDS; round++) {
    for (i = 0; i < SENSORS; i++) {
      unsigned int high = (unsigned char)e_i2cp_read((char)GROUND, 2 * i);
      unsigned int low = (unsigned char)e_i2cp_read((char)GROUND, 2 * i + 1);
      ground[i] += high << 8 | low;
    }
  }
  e_i2cp_disable();
  for (i = 0; i < SENSORS; i++) ground[i] /= ROUNDS;
}

static void control(void) {
  static int last_side = 1, is_lost; /* side: -1 left, 1 right */
  int steer;

  if (ground[0] > DARK && ground[1] > DARK && ground[2] > DARK) {
    if (!is_lost) losses++;
    is_lost = 1;
    e_set_speed_left(last_side * SEARCH);
    e_set_speed_right(-last_side * SEARCH);
    e_set_body_led(1);
    return;
  }
  is_lost = 0;
  steer = ground[0] - ground[2]; /* positive: the right one is darker, turn right */
  if (steer > STEER_LIMIT) steer = STEER_LIMIT;
  if (steer < -STEER_LIMIT) steer = -STEER_LIMIT;
  if (ground[0] < DARK) last_side = -1;
  if (ground[2] < DARK) last_side = 1;
  e_set_speed_left(CRUISE + steer);
  e_set_speed_right(CRUISE - steer);
  e_set_body_led(0);
}

int main(void) {
  e_init_port();
  e_init_motors();
  e_i2cp_init();
  e_start_agendas_processing();
  while (1) {
    read_ground();
    control();
  }
}
