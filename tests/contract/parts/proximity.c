/* SPDX-License-Identifier: MIT
 * Proximity sensors, a white wall whose face is 72.5 mm before the middle, nothing behind; light is even. */
#include "say.h"
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>

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
  end();
}
