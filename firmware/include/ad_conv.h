/* SPDX-License-Identifier: MIT
 * Single conversions, as the library named them before 2006. Behaviour is that of a_d/e_ad_conv.h; the guard
 * is shared with it.
 */
#ifndef _AD_CONV
#define _AD_CONV

/** Configures the converter. */
void InitAd(void);

/** Converts channel 0 to 15, counts 0 to 4095. Blocks for some tens of microseconds. */
int ReadAd(unsigned int channel);

#endif
