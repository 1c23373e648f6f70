/* SPDX-License-Identifier: MIT
 * Delay, selector, battery voltage.
 * Source: [lib: utility/utility.c], facts restated.
 */
#include "utility/utility.h"

#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"
#include "motor_led/e_init_port.h"

#define SELECTOR_PIN 6  /* RG6 to RG9 */

TAKES(0) void wait(long num) { tp_spend((num > 0 ? (tp_i64)num * T_WAIT_ROUND : 0) + T_WAIT); }

TAKES(T_GETSELECTOR) int getselector() { return (int)(tp_pins_read('G') >> SELECTOR_PIN & 15); }

/* the scan's sample of AN7; 0 until the first one */
unsigned int getBatteryValueRaw() {
  if (!isEpuckVersion1_3() || tp_scan_acc_samples() == 0) return 0;
  return (unsigned int)tp_battery_counts();
}
