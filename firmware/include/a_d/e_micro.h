/* SPDX-License-Identifier: MIT
 * Microphones, basic variant: three single conversions. For sound use advance_ad_scan/e_micro.h, whose
 * e_get_micro() has other arguments: never include both.
 */
#ifndef _MICROPHONE
#define _MICROPHONE

#include "../twinpuck.h"

/** Configures the converter: e_init_ad(). */
void e_init_micro(void) TP_VARIANT(tp_basic_, e_init_micro);

/** One raw sample of each microphone, counts 0 to 4095, silence at about 2000.
 *  Blocks for three conversions. Stops timer 1 meanwhile and starts it afterwards, even if it was not
 *  running. */
void e_get_micro(int *m1, int *m2, int *m3) TP_VARIANT(tp_basic_, e_get_micro);

#endif
