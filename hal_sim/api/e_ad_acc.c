/* SPDX-License-Identifier: MIT
 * The ADC scan's samples of the accelerometer; alone, as e_ad_mic.c.
 */
#include "hal.h"

int e_acc_scan[3][ACC_SAMP_NB];

void twinpuck_refresh_acc(void) {
  tp_scan_acc_values(e_acc_scan);
  e_last_acc_scan_id = (unsigned int)tp_scan_acc_index();
}
