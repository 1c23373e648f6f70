/* SPDX-License-Identifier: MIT
 * Selector at 5, a battery that is not low. */
#include "say.h"
#include <motor_led/e_epuck_ports.h>
#include <utility/utility.h>

int main(void) {
  begin();
  say("selector", getselector());
  say("low", BATT_LOW == 0);
  end();
}
