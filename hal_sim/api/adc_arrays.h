/* SPDX-License-Identifier: MIT
 * The ADC driver's public variables, shared by the files of the API that fill them.
 *
 * On the robot the interrupt writes them; here they are brought up to date when a function of the driver is
 * called (e_get_prox() its own two entries, e_ad_is_*() and the stopwatch everything), and when a controller
 * looks at them itself (adc_seen.c).
 * Not modelled: e_mic_scan stays 0.
 */
#ifndef TWINPUCK_API_ADC_ARRAYS_H
#define TWINPUCK_API_ADC_ARRAYS_H

#include "a_d/advance_ad_scan/e_ad_conv.h"

#define IR_CHANNELS 10 /* 8 of the ring, 2 of the gumstix turret */

extern int e_mic_scan[3][MIC_SAMP_NB];
extern int e_acc_scan[3][ACC_SAMP_NB];
extern unsigned int e_last_mic_scan_id;
extern unsigned int e_last_acc_scan_id;
extern int e_ambient_ir[IR_CHANNELS];
extern int e_ambient_and_reflected_ir[IR_CHANNELS];
extern int selector;
extern unsigned int tickAdcIsr;
extern unsigned char updateAccI2CCounter;

/** Interrupts that the counters know of. */
extern unsigned long twinpuck_interrupts_seen;

/** Counters and indices as the interrupt would have left them. */
void twinpuck_refresh_adc_counters(void);
/** Accelerometer samples and the index of the newest. */
void twinpuck_refresh_acc(void);
/** One sensor's two entries. */
void twinpuck_refresh_ir(unsigned int sensor);

#endif
