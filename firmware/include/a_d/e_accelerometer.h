/* SPDX-License-Identifier: MIT
 * Accelerometer, basic variant (robots before revision 1.3). The advanced one is advance_ad_scan/e_acc.h,
 * whose e_get_acc() has other arguments: never include both.
 */
#ifndef _ACCELEROMETER
#define _ACCELEROMETER

#include "../twinpuck.h"

/** Configures the converter: e_init_ad(). */
void e_init_acc(void) TP_VARIANT(tp_basic_, e_init_acc);

/** Raw samples of the three axes, counts 0 to 4095, 0 g at about 2048, about 800 counts per g.
 *  Blocks for three conversions. Stops timer 1 meanwhile and starts it afterwards, even if it was not
 *  running. */
void e_get_acc(int *x, int *y, int *z) TP_VARIANT(tp_basic_, e_get_acc);

#endif
