/* SPDX-License-Identifier: MIT
 * The battery's charge. Source: [lib: utility/utility.c], facts restated.
 */
#include "motor_led/e_init_port.h"
#include "utility/utility.h"

#define BATTERY_EMPTY 2070 /* counts at 3.4 V */
#define BATTERY_RANGE 490  /* counts from there to 4.2 V */

unsigned int getBatteryValuePercentage() {
  if (!isEpuckVersion1_3()) return 0;
  return (unsigned int)(100 * (float)((int)getBatteryValueRaw() - BATTERY_EMPTY) / (float)BATTERY_RANGE);
}
