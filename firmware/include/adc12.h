/* SPDX-License-Identifier: MIT
 * Settings of the 12-bit converter under the names of Microchip's peripheral library: each is a mask that clears what
 * the choice clears; those of one register are combined with &. Constants alone. Source: bit fields [DS70143 18].
 */
#ifndef TWINPUCK_ADC12_H
#define TWINPUCK_ADC12_H
#ifndef __TWINPUCK__
#include_next <adc12.h>
#else
#include "p30F6014A.h"

/* ADCON1 */
#define ADC_MODULE_ON         0xFFFF
#define ADC_MODULE_OFF        0x7FFF
#define ADC_IDLE_STOP         0xFFFF
#define ADC_IDLE_CONTINUE     0xDFFF
#define ADC_FORMAT_SIGN_FRACT 0xFFFF
#define ADC_FORMAT_FRACT      0xFEFF
#define ADC_FORMAT_SIGN_INT   0xFDFF
#define ADC_FORMAT_INTG       0xFCFF
#define ADC_CLK_AUTO          0xFFFF
#define ADC_CLK_MPWM          0xFF7F
#define ADC_CLK_TMR           0xFF5F
#define ADC_CLK_INT0          0xFF3F
#define ADC_CLK_MANUAL        0xFF1F
#define ADC_AUTO_SAMPLING_ON  0xFFFF
#define ADC_AUTO_SAMPLING_OFF 0xFFFB
#define ADC_SAMP_ON           0xFFFF
#define ADC_SAMP_OFF          0xFFFD

/* ADCON2 */
#define ADC_VREF_EXT_EXT       0x7FFF
#define ADC_VREF_AVDD_EXT      0x5FFF
#define ADC_VREF_EXT_AVSS      0x3FFF
#define ADC_VREF_AVDD_AVSS     0x1FFF
#define ADC_SCAN_ON            0xFFFF
#define ADC_SCAN_OFF           0xFBFF
#define ADC_SAMPLES_PER_INT_1  0xFFC3
#define ADC_SAMPLES_PER_INT_2  0xFFC7
#define ADC_SAMPLES_PER_INT_3  0xFFCB
#define ADC_SAMPLES_PER_INT_4  0xFFCF
#define ADC_SAMPLES_PER_INT_5  0xFFD3
#define ADC_SAMPLES_PER_INT_6  0xFFD7
#define ADC_SAMPLES_PER_INT_7  0xFFDB
#define ADC_SAMPLES_PER_INT_8  0xFFDF
#define ADC_SAMPLES_PER_INT_9  0xFFE3
#define ADC_SAMPLES_PER_INT_10 0xFFE7
#define ADC_SAMPLES_PER_INT_11 0xFFEB
#define ADC_SAMPLES_PER_INT_12 0xFFEF
#define ADC_SAMPLES_PER_INT_13 0xFFF3
#define ADC_SAMPLES_PER_INT_14 0xFFF7
#define ADC_SAMPLES_PER_INT_15 0xFFFB
#define ADC_SAMPLES_PER_INT_16 0xFFFF
#define ADC_ALT_BUF_ON         0xFFFF
#define ADC_ALT_BUF_OFF        0xFFFD
#define ADC_ALT_INPUT_ON       0xFFFF
#define ADC_ALT_INPUT_OFF      0xFFFE

/* ADCON3; nTcy2 is n halves of an instruction cycle */
#define ADC_SAMPLE_TIME_0        0xE0FF
#define ADC_SAMPLE_TIME_1        0xE1FF
#define ADC_SAMPLE_TIME_2        0xE2FF
#define ADC_SAMPLE_TIME_3        0xE3FF
#define ADC_SAMPLE_TIME_4        0xE4FF
#define ADC_SAMPLE_TIME_5        0xE5FF
#define ADC_SAMPLE_TIME_6        0xE6FF
#define ADC_SAMPLE_TIME_7        0xE7FF
#define ADC_SAMPLE_TIME_8        0xE8FF
#define ADC_SAMPLE_TIME_9        0xE9FF
#define ADC_SAMPLE_TIME_10       0xEAFF
#define ADC_SAMPLE_TIME_11       0xEBFF
#define ADC_SAMPLE_TIME_12       0xECFF
#define ADC_SAMPLE_TIME_13       0xEDFF
#define ADC_SAMPLE_TIME_14       0xEEFF
#define ADC_SAMPLE_TIME_15       0xEFFF
#define ADC_SAMPLE_TIME_16       0xF0FF
#define ADC_SAMPLE_TIME_17       0xF1FF
#define ADC_SAMPLE_TIME_18       0xF2FF
#define ADC_SAMPLE_TIME_19       0xF3FF
#define ADC_SAMPLE_TIME_20       0xF4FF
#define ADC_SAMPLE_TIME_21       0xF5FF
#define ADC_SAMPLE_TIME_22       0xF6FF
#define ADC_SAMPLE_TIME_23       0xF7FF
#define ADC_SAMPLE_TIME_24       0xF8FF
#define ADC_SAMPLE_TIME_25       0xF9FF
#define ADC_SAMPLE_TIME_26       0xFAFF
#define ADC_SAMPLE_TIME_27       0xFBFF
#define ADC_SAMPLE_TIME_28       0xFCFF
#define ADC_SAMPLE_TIME_29       0xFDFF
#define ADC_SAMPLE_TIME_30       0xFEFF
#define ADC_SAMPLE_TIME_31       0xFFFF
#define ADC_CONV_CLK_INTERNAL_RC 0xFFFF
#define ADC_CONV_CLK_SYSTEM      0xFF7F
#define ADC_CONV_CLK_Tcy2        0xFFC0
#define ADC_CONV_CLK_Tcy         0xFFC1
#define ADC_CONV_CLK_3Tcy2       0xFFC2
#define ADC_CONV_CLK_2Tcy        0xFFC3
#define ADC_CONV_CLK_5Tcy2       0xFFC4
#define ADC_CONV_CLK_3Tcy        0xFFC5
#define ADC_CONV_CLK_7Tcy2       0xFFC6
#define ADC_CONV_CLK_4Tcy        0xFFC7
#define ADC_CONV_CLK_9Tcy2       0xFFC8
#define ADC_CONV_CLK_5Tcy        0xFFC9
#define ADC_CONV_CLK_11Tcy2      0xFFCA
#define ADC_CONV_CLK_6Tcy        0xFFCB
#define ADC_CONV_CLK_13Tcy2      0xFFCC
#define ADC_CONV_CLK_7Tcy        0xFFCD
#define ADC_CONV_CLK_15Tcy2      0xFFCE
#define ADC_CONV_CLK_8Tcy        0xFFCF
#define ADC_CONV_CLK_17Tcy2      0xFFD0
#define ADC_CONV_CLK_9Tcy        0xFFD1
#define ADC_CONV_CLK_19Tcy2      0xFFD2
#define ADC_CONV_CLK_10Tcy       0xFFD3
#define ADC_CONV_CLK_21Tcy2      0xFFD4
#define ADC_CONV_CLK_11Tcy       0xFFD5
#define ADC_CONV_CLK_23Tcy2      0xFFD6
#define ADC_CONV_CLK_12Tcy       0xFFD7
#define ADC_CONV_CLK_25Tcy2      0xFFD8
#define ADC_CONV_CLK_13Tcy       0xFFD9
#define ADC_CONV_CLK_27Tcy2      0xFFDA
#define ADC_CONV_CLK_14Tcy       0xFFDB
#define ADC_CONV_CLK_29Tcy2      0xFFDC
#define ADC_CONV_CLK_15Tcy       0xFFDD
#define ADC_CONV_CLK_31Tcy2      0xFFDE
#define ADC_CONV_CLK_16Tcy       0xFFDF
#define ADC_CONV_CLK_33Tcy2      0xFFE0
#define ADC_CONV_CLK_17Tcy       0xFFE1
#define ADC_CONV_CLK_35Tcy2      0xFFE2
#define ADC_CONV_CLK_18Tcy       0xFFE3
#define ADC_CONV_CLK_37Tcy2      0xFFE4
#define ADC_CONV_CLK_19Tcy       0xFFE5
#define ADC_CONV_CLK_39Tcy2      0xFFE6
#define ADC_CONV_CLK_20Tcy       0xFFE7
#define ADC_CONV_CLK_41Tcy2      0xFFE8
#define ADC_CONV_CLK_21Tcy       0xFFE9
#define ADC_CONV_CLK_43Tcy2      0xFFEA
#define ADC_CONV_CLK_22Tcy       0xFFEB
#define ADC_CONV_CLK_45Tcy2      0xFFEC
#define ADC_CONV_CLK_23Tcy       0xFFED
#define ADC_CONV_CLK_47Tcy2      0xFFEE
#define ADC_CONV_CLK_24Tcy       0xFFEF
#define ADC_CONV_CLK_49Tcy2      0xFFF0
#define ADC_CONV_CLK_25Tcy       0xFFF1
#define ADC_CONV_CLK_51Tcy2      0xFFF2
#define ADC_CONV_CLK_26Tcy       0xFFF3
#define ADC_CONV_CLK_53Tcy2      0xFFF4
#define ADC_CONV_CLK_27Tcy       0xFFF5
#define ADC_CONV_CLK_55Tcy2      0xFFF6
#define ADC_CONV_CLK_28Tcy       0xFFF7
#define ADC_CONV_CLK_57Tcy2      0xFFF8
#define ADC_CONV_CLK_29Tcy       0xFFF9
#define ADC_CONV_CLK_59Tcy2      0xFFFA
#define ADC_CONV_CLK_30Tcy       0xFFFB
#define ADC_CONV_CLK_61Tcy2      0xFFFC
#define ADC_CONV_CLK_31Tcy       0xFFFD
#define ADC_CONV_CLK_63Tcy2      0xFFFE
#define ADC_CONV_CLK_32Tcy       0xFFFF

#endif
#endif
