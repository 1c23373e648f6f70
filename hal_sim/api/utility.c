/* SPDX-License-Identifier: MIT
 * Delay, selector, battery voltage.
 * Source: [lib: utility/utility.c], facts restated.
 */
#include "utility/utility.h"

#include "hal_sim/host/pins.h"
#include "motor_led/e_init_port.h"

#define ROUND_CYCLES 10 /* a round of an empty loop over a long [estimated: load, add, store, compare] */
#define SELECTOR_PIN 6  /* RG6 to RG9 */

void wait(long num) {
  if (num > 0) tp_spend((tp_i64)num * ROUND_CYCLES);
}

int getselector() { return (int)(tp_pins_read('G') >> SELECTOR_PIN & 15); }

/* the scan's sample of AN7; 0 until the first one */
unsigned int getBatteryValueRaw() {
  if (!isEpuckVersion1_3() || tp_scan_acc_samples() == 0) return 0;
  return (unsigned int)tp_battery_counts();
}
