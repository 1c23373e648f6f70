/* SPDX-License-Identifier: MIT
 * The ADC driver's public variables, shared by the files that fill them and those that read them. The scan's
 * interrupt writes them; linked with hal_sim they are served like registers (hal_sim/api/scan_variables.h).
 */
#ifndef HAL_COMMON_ADC_ARRAYS_H
#define HAL_COMMON_ADC_ARRAYS_H

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

#endif
