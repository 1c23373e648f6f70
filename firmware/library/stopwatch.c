/* SPDX-License-Identifier: MIT
 * The stopwatch that counts interrupts of the ADC scan. Source: [lib: utility/utility.c], facts restated.
 */
#include "hal.h"
#include "utility/utility.h"

void resetTime(void) {
  hal_restart_ticks();
}

float getDiffTimeMs(void) {
  return (float)tickAdcIsr * (float)ADC_ISR_PERIOD_MS;
}

float getDiffTimeMsAndReset(void) {
  float elapsed_ms = getDiffTimeMs();
  hal_restart_ticks();
  return elapsed_ms;
}
