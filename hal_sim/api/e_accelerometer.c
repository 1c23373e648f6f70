/* SPDX-License-Identifier: MIT
 * Accelerometer, basic variant: three conversions while Timer 1, the proximity driver's, stands still.
 * Source: [lib: a_d/e_accelerometer.c], facts restated.
 */
#include "a_d/e_accelerometer.h"

#include "a_d/e_ad_conv.h"
#include "hal_sim/host/pins.h"

#define CHANNEL_X 5
#define CHANNEL_Y 6
#define CHANNEL_Z 7

void e_init_acc(void) { e_init_ad(); }

void e_get_acc(int *x, int *y, int *z) {
  tp_basic_prox_hold();
  *x = e_read_ad(CHANNEL_X);
  *y = e_read_ad(CHANNEL_Y);
  *z = e_read_ad(CHANNEL_Z);
  tp_basic_prox_release();
}
