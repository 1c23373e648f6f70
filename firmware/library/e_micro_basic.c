/* SPDX-License-Identifier: MIT
 * Microphones, basic variant: three single conversions.
 * Source: [lib: a_d/e_micro.c], facts restated.
 */
#include "a_d/e_micro.h"

#include "a_d/e_ad_conv.h"
#include "motor_led/e_epuck_ports.h"

void e_init_micro(void) { e_init_ad(); }

void e_get_micro(int *m1, int *m2, int *m3) {
  T1CONbits.TON = 0; /* the basic proximity driver must not convert meanwhile */
  *m1 = e_read_ad(MIC1);
  *m2 = e_read_ad(MIC2);
  *m3 = e_read_ad(MIC3);
  T1CONbits.TON = 1;
}
