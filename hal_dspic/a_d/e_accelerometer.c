/* SPDX-License-Identifier: MIT
 * Accelerometer, basic variant: three conversions while Timer 1, the proximity driver's, stands still.
 * Source: [lib: a_d/e_accelerometer.c], facts restated.
 */
#include "a_d/e_accelerometer.h"

#include "a_d/e_ad_conv.h"
#include "motor_led/e_epuck_ports.h"

void e_init_acc(void) { e_init_ad(); }

void e_get_acc(int *x, int *y, int *z) {
  T1CONbits.TON = 0;
  *x = e_read_ad(ACCX);
  *y = e_read_ad(ACCY);
  *z = e_read_ad(ACCZ);
  T1CONbits.TON = 1;
}
