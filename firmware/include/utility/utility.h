/* SPDX-License-Identifier: MIT
 * Odds and ends that most programs share. Like the original this file has no guard; repeating it is harmless.
 */
#include "../twinpuck.h"

/** Counts to `num` in a loop: about 0.7 us a round unoptimised. Blocks; interrupts go on. */
void wait(long num);

/** Position of the rotary selector, 0 to 15. */
int getselector();

/** Battery voltage, raw: revision 1.3 a sample of the ADC scan (2070 = 3.4 V, 2560 = 4.2 V), else 0. */
unsigned int getBatteryValueRaw();

/** Battery charge in percent, not limited to 0..100: revision 1.3 only, else 0. */
unsigned int getBatteryValuePercentage();

/** A stopwatch that counts interrupts of the ADC scan (0.061 ms each; half of that with MICRO_ONLY). It
 *  stands while the scan does not run and stops at 4 s. resetTime() starts it; the others return
 *  milliseconds. */
void resetTime(void);
float getDiffTimeMs(void);
float getDiffTimeMsAndReset(void);
