/* SPDX-License-Identifier: MIT
 * Battery voltage of revision 1.3, where it takes the place of the accelerometer's z axis in the scan.
 * Source: [lib: utility/utility.c], facts restated.
 */
#include "hal.h"
#include "motor_led/e_init_port.h"
#include "utility/utility.h"

unsigned int getBatteryValueRaw() {
  return isEpuckVersion1_3() ? (unsigned int)e_acc_scan[2][e_last_acc_scan_id] : 0;
}
