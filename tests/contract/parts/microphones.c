/* SPDX-License-Identifier: MIT
 * Microphones in silence: the middle of the converter's range but for noise. */
#include "say.h"
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_micro.h>

int main(void) {
  begin();
  e_init_ad_scan(MICRO_ONLY);
  pause_ms(50);
  say("one", e_get_micro_average(0, 50));
  say("two", e_get_micro_average(1, 50));
  say("three", e_get_micro_average(2, 50));
  say("all", e_get_micro_average(0, MIC_SAMP_NB));
  say("more", e_get_micro_average(0, MIC_SAMP_NB + 1));
  say("nobody", e_get_micro_average(3, 50));
  say("loud", e_get_micro_volume(0) > 20);
  end();
}
