/* SPDX-License-Identifier: MIT
 * Motors of the basic library, on timers 5 and 4. */
#include "say.h"
#include <motor_led/e_motors.h>

int main(void) {
  begin();
  e_init_motors();
  e_set_steps_left(0);
  e_set_steps_right(0);
  e_set_speed_left(500);
  e_set_speed_right(-1000);
  pause_ms(1000);
  say("left", e_get_steps_left());
  say("right", e_get_steps_right());
  /* both ends of the speeds: -32768 has no magnitude */
  e_set_speed_left(-32767);
  e_set_speed_right(32767);
  say("fast_left", PR5);
  say("fast_right", PR4);
  e_set_speed_left(-32767 - 1);
  e_set_speed_right(-32767 - 1);
  say("none_left", PR5 == 0xFFFF);
  say("none_right", PR4 == 0xFFFF);
  e_set_speed_left(0);
  e_set_speed_right(0);
  end();
}
