/* SPDX-License-Identifier: MIT
 * Proximity sensors, basic variant, on Timer 2: see basic_prox.h.
 */
#define E_PROX_TIMER2
#include "a_d/e_prox.h"

#define PROX_HANDLER _T2Interrupt
#define PROX_CLEAR_FLAG() IFS0bits.T2IF = 0
#define PROX_SET_PERIOD(counts) PR2 = (counts)
#define PROX_STOP() T2CONbits.TON = 0
#define PROX_START()      \
  do {                    \
    T2CON = 0;            \
    T2CONbits.TCKPS = 1;  \
    TMR2 = 0;             \
    PR2 = PULSE_COUNTS;   \
    IFS0bits.T2IF = 0;    \
    IEC0bits.T2IE = 1;    \
    T2CONbits.TON = 1;    \
  } while (0)

#include "basic_prox.h"
