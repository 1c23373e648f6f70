/* SPDX-License-Identifier: MIT
 * Single conversions by the program itself.
 * Source: [lib: a_d/e_ad_conv.c], facts restated.
 */
#include "a_d/e_ad_conv.h"

#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"

#define LAST_CHANNEL 15
#define SAMPLING_CYCLES 166   /* 40 rounds of 4 cycles, set-up [measured: register way, a call takes 322] */
#define CONVERSION_CYCLES 132 /* 14 TAD of 9.5 cycles [the same] */

TAKES(T_INIT_AD) void e_init_ad(void) {}

int e_read_ad(unsigned int channel) {
  int counts;
  if (channel > LAST_CHANNEL) return 0;
  tp_spend(SAMPLING_CYCLES);
  counts = (int)tp_convert(channel);
  tp_spend(CONVERSION_CYCLES);
  return counts;
}
