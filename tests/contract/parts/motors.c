/* SPDX-License-Identifier: MIT
 * Motors on agendas: speeds are whole numbers of 0.1 ms ticks a step, 10000 / 14 and 10000 / 28. */
#include "say.h"
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>

int main(void) {
  begin();
  e_init_motors();
  e_start_agendas_processing();
  e_set_steps_left(0);
  e_set_steps_right(1000);
  e_set_speed(400, 200); /* linear, angular: left 200, right 600 */
  pause_ms(1000);
  say("left", e_get_steps_left());
  say("right", e_get_steps_right());
  e_set_speed_left(700);
  e_set_speed_right(-350);
  e_set_steps_left(0);
  e_set_steps_right(0);
  pause_ms(1000);
  say("fast", e_get_steps_left());
  say("back", e_get_steps_right());
  e_set_speed_left(0);
  e_set_speed_right(0);
  e_set_steps_left(7);
  pause_ms(100);
  say("still", e_get_steps_left());
  end();
}
