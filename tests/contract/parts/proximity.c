/* SPDX-License-Identifier: MIT
 * Proximity sensors, a white wall whose face is 72.5 mm before the middle, nothing behind; light is even. */
#include "say.h"
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_motors.h>

int main(void) {
  int i, lit = 0;
  begin();
  e_init_ad_scan(ALL_ADC);
  pause_ms(100);
  say("right", e_get_prox(0));
  say("left", e_get_prox(7));
  say("behind", e_get_prox(3));
  for (i = 0; i < 8; i++)
    if (e_get_ambient_light(i) > 3000) lit++;
  say("ambient", lit);
  e_calibrate_ir();
  say("zero", e_get_calibrated_prox(0));
  /* half a turn: 647 steps of 0.1288 mm a wheel, 53 mm apart; what was near is far, which is not less than nothing */
  e_init_motors();
  e_start_agendas_processing();
  e_set_speed_left(647);
  e_set_speed_right(-647);
  pause_ms(1000);
  e_set_speed_left(0);
  e_set_speed_right(0);
  pause_ms(100);
  say("turned", e_get_prox(0) < 50);
  say("nothing", e_get_calibrated_prox(0));
  say("nothing7", e_get_calibrated_prox(7));
  say("behind", e_get_calibrated_prox(3) > 60);
  end();
}
