/* SPDX-License-Identifier: MIT
 * Timers 1 to 5 under the names of Microchip's peripheral library: settings are masks, combined with &. Nothing
 * blocks. Source: bit fields [DS70143 9 to 11].
 */
#ifndef TWINPUCK_TIMER_H
#define TWINPUCK_TIMER_H
#ifndef __TWINPUCK__
#include_next <timer.h>
#else
#include "p30F6014A.h"

/* T1CON; ConfigIntTimer1() */
#define T1_ON           0xFFFF
#define T1_OFF          0x7FFF
#define T1_IDLE_STOP    0xFFFF
#define T1_IDLE_CON     0xDFFF
#define T1_GATE_ON      0xFFFF
#define T1_GATE_OFF     0xFFBF
#define T1_PS_1_1       0xFFCF
#define T1_PS_1_8       0xFFDF
#define T1_PS_1_64      0xFFEF
#define T1_PS_1_256     0xFFFF
#define T1_SYNC_EXT_ON  0xFFFF
#define T1_SYNC_EXT_OFF 0xFFFB
#define T1_SOURCE_EXT   0xFFFF
#define T1_SOURCE_INT   0xFFFD
#define T1_INT_PRIOR_0  0xFFF8
#define T1_INT_PRIOR_1  0xFFF9
#define T1_INT_PRIOR_2  0xFFFA
#define T1_INT_PRIOR_3  0xFFFB
#define T1_INT_PRIOR_4  0xFFFC
#define T1_INT_PRIOR_5  0xFFFD
#define T1_INT_PRIOR_6  0xFFFE
#define T1_INT_PRIOR_7  0xFFFF
#define T1_INT_ON       0xFFFF
#define T1_INT_OFF      0xFFF7

/* T2CON; ConfigIntTimer2() */
#define T2_ON             0xFFFF
#define T2_OFF            0x7FFF
#define T2_IDLE_STOP      0xFFFF
#define T2_IDLE_CON       0xDFFF
#define T2_GATE_ON        0xFFFF
#define T2_GATE_OFF       0xFFBF
#define T2_PS_1_1         0xFFCF
#define T2_PS_1_8         0xFFDF
#define T2_PS_1_64        0xFFEF
#define T2_PS_1_256       0xFFFF
#define T2_32BIT_MODE_ON  0xFFFF
#define T2_32BIT_MODE_OFF 0xFFF7
#define T2_SOURCE_EXT     0xFFFF
#define T2_SOURCE_INT     0xFFFD
#define T2_INT_PRIOR_0    0xFFF8
#define T2_INT_PRIOR_1    0xFFF9
#define T2_INT_PRIOR_2    0xFFFA
#define T2_INT_PRIOR_3    0xFFFB
#define T2_INT_PRIOR_4    0xFFFC
#define T2_INT_PRIOR_5    0xFFFD
#define T2_INT_PRIOR_6    0xFFFE
#define T2_INT_PRIOR_7    0xFFFF
#define T2_INT_ON         0xFFFF
#define T2_INT_OFF        0xFFF7

/* T3CON; ConfigIntTimer3() */
#define T3_ON          0xFFFF
#define T3_OFF         0x7FFF
#define T3_IDLE_STOP   0xFFFF
#define T3_IDLE_CON    0xDFFF
#define T3_GATE_ON     0xFFFF
#define T3_GATE_OFF    0xFFBF
#define T3_PS_1_1      0xFFCF
#define T3_PS_1_8      0xFFDF
#define T3_PS_1_64     0xFFEF
#define T3_PS_1_256    0xFFFF
#define T3_SOURCE_EXT  0xFFFF
#define T3_SOURCE_INT  0xFFFD
#define T3_INT_PRIOR_0 0xFFF8
#define T3_INT_PRIOR_1 0xFFF9
#define T3_INT_PRIOR_2 0xFFFA
#define T3_INT_PRIOR_3 0xFFFB
#define T3_INT_PRIOR_4 0xFFFC
#define T3_INT_PRIOR_5 0xFFFD
#define T3_INT_PRIOR_6 0xFFFE
#define T3_INT_PRIOR_7 0xFFFF
#define T3_INT_ON      0xFFFF
#define T3_INT_OFF     0xFFF7

/* T4CON; ConfigIntTimer4() */
#define T4_ON             0xFFFF
#define T4_OFF            0x7FFF
#define T4_IDLE_STOP      0xFFFF
#define T4_IDLE_CON       0xDFFF
#define T4_GATE_ON        0xFFFF
#define T4_GATE_OFF       0xFFBF
#define T4_PS_1_1         0xFFCF
#define T4_PS_1_8         0xFFDF
#define T4_PS_1_64        0xFFEF
#define T4_PS_1_256       0xFFFF
#define T4_32BIT_MODE_ON  0xFFFF
#define T4_32BIT_MODE_OFF 0xFFF7
#define T4_SOURCE_EXT     0xFFFF
#define T4_SOURCE_INT     0xFFFD
#define T4_INT_PRIOR_0    0xFFF8
#define T4_INT_PRIOR_1    0xFFF9
#define T4_INT_PRIOR_2    0xFFFA
#define T4_INT_PRIOR_3    0xFFFB
#define T4_INT_PRIOR_4    0xFFFC
#define T4_INT_PRIOR_5    0xFFFD
#define T4_INT_PRIOR_6    0xFFFE
#define T4_INT_PRIOR_7    0xFFFF
#define T4_INT_ON         0xFFFF
#define T4_INT_OFF        0xFFF7

/* T5CON; ConfigIntTimer5() */
#define T5_ON          0xFFFF
#define T5_OFF         0x7FFF
#define T5_IDLE_STOP   0xFFFF
#define T5_IDLE_CON    0xDFFF
#define T5_GATE_ON     0xFFFF
#define T5_GATE_OFF    0xFFBF
#define T5_PS_1_1      0xFFCF
#define T5_PS_1_8      0xFFDF
#define T5_PS_1_64     0xFFEF
#define T5_PS_1_256    0xFFFF
#define T5_SOURCE_EXT  0xFFFF
#define T5_SOURCE_INT  0xFFFD
#define T5_INT_PRIOR_0 0xFFF8
#define T5_INT_PRIOR_1 0xFFF9
#define T5_INT_PRIOR_2 0xFFFA
#define T5_INT_PRIOR_3 0xFFFB
#define T5_INT_PRIOR_4 0xFFFC
#define T5_INT_PRIOR_5 0xFFFD
#define T5_INT_PRIOR_6 0xFFFE
#define T5_INT_PRIOR_7 0xFFFF
#define T5_INT_ON      0xFFFF
#define T5_INT_OFF     0xFFF7

#define TP_TIMER(n, flags, enables, priorities)                                                                       \
  static __inline__ void OpenTimer##n(unsigned int config, unsigned int period) {                                     \
    TMR##n = 0;                                                                                                       \
    PR##n = period;                                                                                                   \
    T##n##CON = config;                                                                                               \
  }                                                                                                                   \
  static __inline__ void CloseTimer##n(void) {                                                                        \
    enables.T##n##IE = 0;                                                                                             \
    T##n##CONbits.TON = 0;                                                                                            \
    flags.T##n##IF = 0;                                                                                               \
  }                                                                                                                   \
  static __inline__ void ConfigIntTimer##n(unsigned int config) {                                                     \
    flags.T##n##IF = 0;                                                                                               \
    priorities.T##n##IP = config & 7;                                                                                 \
    enables.T##n##IE = config >> 3 & 1;                                                                               \
  }                                                                                                                   \
  static __inline__ unsigned int ReadTimer##n(void) { return TMR##n; }                                                \
  static __inline__ void WriteTimer##n(unsigned int count) { TMR##n = count; }
TP_TIMER(1, IFS0bits, IEC0bits, IPC0bits)
TP_TIMER(2, IFS0bits, IEC0bits, IPC1bits)
TP_TIMER(3, IFS0bits, IEC0bits, IPC1bits)
TP_TIMER(4, IFS1bits, IEC1bits, IPC5bits)
TP_TIMER(5, IFS1bits, IEC1bits, IPC5bits)

/* two timers as one of 32 bits, whose interrupt is the upper one's */
#define TP_TIMER_PAIR(low, high, flags, enables, priorities)                                                          \
  static __inline__ void OpenTimer##low##high(unsigned int config, unsigned long period) {                            \
    TMR##high = 0;                                                                                                    \
    TMR##low = 0;                                                                                                     \
    PR##high = (unsigned int)(period >> 16);                                                                          \
    PR##low = (unsigned int)period;                                                                                   \
    T##low##CON = config;                                                                                             \
    T##low##CONbits.T32 = 1;                                                                                          \
  }                                                                                                                   \
  static __inline__ void CloseTimer##low##high(void) {                                                                \
    enables.T##high##IE = 0;                                                                                          \
    T##low##CONbits.TON = 0;                                                                                          \
    flags.T##high##IF = 0;                                                                                            \
  }                                                                                                                   \
  static __inline__ void ConfigIntTimer##low##high(unsigned int config) {                                             \
    flags.T##high##IF = 0;                                                                                            \
    priorities.T##high##IP = config & 7;                                                                              \
    enables.T##high##IE = config >> 3 & 1;                                                                            \
  }                                                                                                                   \
  static __inline__ unsigned long ReadTimer##low##high(void) {                                                        \
    unsigned int count = TMR##low; /* which holds the upper half */                                                   \
    return (unsigned long)TMR##high##HLD << 16 | count;                                                               \
  }                                                                                                                   \
  static __inline__ void WriteTimer##low##high(unsigned long count) {                                                 \
    TMR##high##HLD = (unsigned int)(count >> 16);                                                                     \
    TMR##low = (unsigned int)count;                                                                                   \
  }
TP_TIMER_PAIR(2, 3, IFS0bits, IEC0bits, IPC1bits)
TP_TIMER_PAIR(4, 5, IFS1bits, IEC1bits, IPC5bits)

#define EnableIntT1 IEC0bits.T1IE = 1
#define DisableIntT1 IEC0bits.T1IE = 0
#define SetPriorityIntT1(priority) (IPC0bits.T1IP = (priority))
#define EnableIntT2 IEC0bits.T2IE = 1
#define DisableIntT2 IEC0bits.T2IE = 0
#define SetPriorityIntT2(priority) (IPC1bits.T2IP = (priority))
#define EnableIntT3 IEC0bits.T3IE = 1
#define DisableIntT3 IEC0bits.T3IE = 0
#define SetPriorityIntT3(priority) (IPC1bits.T3IP = (priority))
#define EnableIntT4 IEC1bits.T4IE = 1
#define DisableIntT4 IEC1bits.T4IE = 0
#define SetPriorityIntT4(priority) (IPC5bits.T4IP = (priority))
#define EnableIntT5 IEC1bits.T5IE = 1
#define DisableIntT5 IEC1bits.T5IE = 0
#define SetPriorityIntT5(priority) (IPC5bits.T5IP = (priority))

#endif
#endif
