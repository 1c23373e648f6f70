/* SPDX-License-Identifier: MIT
 * Analogue inputs, advanced variant (the usual one): the converter scans by itself, and its interrupt
 * (priority 4) files the samples. Getters of e_prox.h, e_acc.h and e_micro.h then only read memory.
 *
 * One interrupt every 65 us (16384 Hz nominal, 15.28 kHz at -O1). Three microphones each time; the accelerometer once in 65,
 * which is 235 Hz; one pair of IR sensors once in 65, all eight every 17.0 ms (59 Hz). The scan takes a
 * noticeable share of the processor. All samples are 12 bits, 0 to 4095.
 * Shares its guard with the basic e_ad_conv.h.
 */
#ifndef _AD_CONV
#define _AD_CONV

#include "../../twinpuck.h"

#define MIC_SAMP_FREQ 16384.0     /* Hz, nominal */
#define ACC_PROX_SAMP_FREQ 256.0  /* Hz, nominal */
#define PULSE_LENGHT 0.0003       /* s, wanted length of an IR pulse (name as in the original) */

/* derived counts of interrupts; integer conversion truncates, so PULSE_PERIOD is 4 */
#define ACC_PROX_PERIOD (int)(MIC_SAMP_FREQ/ACC_PROX_SAMP_FREQ)
#define PULSE_PERIOD (int)(PULSE_LENGHT*MIC_SAMP_FREQ)

/* converter clock for scans of 2, 3, 5, 6 channels; needs e_epuck_ports.h for FCY */
#define ADCS_3_CHAN (int)(2.0*FCY/(MIC_SAMP_FREQ*(14+1)*3)-1)
#define ADCS_5_CHAN (int)(2.0*FCY/(MIC_SAMP_FREQ*(14+1)*5)-1)
#define ADCS_6_CHAN (int)(2.0*FCY/(MIC_SAMP_FREQ*(14+1)*6)-1)
#define ADCS_2_CHAN (int)(2.0*FCY/(MIC_SAMP_FREQ*(14+1)*2)-1)

#define MIC_SAMP_NB 100 /* samples kept per microphone, 6.5 ms */
#define ACC_SAMP_NB 50  /* samples kept per axis, 213 ms */

/* argument of e_init_ad_scan() */
#define MICRO_ONLY 1 /* microphones alone, at 32768 Hz */
#define ALL_ADC 0    /* everything */

#define ADC_ISR_PERIOD_MS 0.061 /* ms */

/** Starts the scan. ALL_ADC: blocks for about 208 ms, until the accelerometer's buffer is full. MICRO_ONLY:
 *  does not block; IR and accelerometer values then never change. With selector 10 two more IR sensors
 *  (gumstix turret, pins AN0 and AN1) join the scan and the interrupt's priority is 6. */
void e_init_ad_scan(unsigned char only_micro);
#ifdef __TWINPUCK__
/** As older programs call it: everything. */
TP_OLDER_CALL void e_init_ad_scan(void) { e_init_ad_scan(ALL_ADC); }
#endif

/** 1 for one interrupt period (65 us) after the microphone buffers have wrapped, else 0. Poll it without
 *  pause. */
unsigned char e_ad_is_array_filled(void);

/** 0 while the interrupt files samples, else 1; the main program therefore always sees 1 once the scan
 *  runs. */
unsigned char e_ad_is_acquisition_completed(void);

/** Converter on, off; buffers keep their content. Do not block. */
void e_ad_scan_on(void);
void e_ad_scan_off(void);

/* Variables of the driver that programs read by declaring them themselves:
 *   extern int e_mic_scan[3][MIC_SAMP_NB];            samples of microphones 0 right, 1 left, 2 back
 *   extern unsigned int e_last_mic_scan_id;           index of the oldest sample (next to be overwritten)
 *   extern int e_acc_scan[3][ACC_SAMP_NB];            samples of axes x, y, z
 *   extern unsigned int e_last_acc_scan_id;           index of the newest sample
 *   extern int e_ambient_ir[10];                      dark samples of the IR sensors
 *   extern int e_ambient_and_reflected_ir[10];        lit samples
 *   extern int selector;                              selector position when the scan was started
 *   extern unsigned int tickAdcIsr;                   interrupts counted, stays at 65535
 *   extern unsigned char updateAccI2CCounter;         interrupts since the I2C accelerometer was read, stays
 *  at 64
 */

#endif
