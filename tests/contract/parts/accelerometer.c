/* SPDX-License-Identifier: MIT
 * Accelerometer on a level floor: means of 40 samples, and one after calibration. */
#include "say.h"
#include <a_d/advance_ad_scan/e_acc.h>
#include <a_d/advance_ad_scan/e_ad_conv.h>

int main(void) {
  begin();
  e_init_ad_scan(ALL_ADC);
  pause_ms(300);
  e_acc_calibr();
  pause_ms(100);
  say("x", e_get_acc_filtered(0, 40));
  say("y", e_get_acc_filtered(1, 40));
  say("z", e_get_acc_filtered(2, 40));
  say("calibrated", e_get_acc(2));
  end();
}
