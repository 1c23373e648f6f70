/* SPDX-License-Identifier: MIT
 * Proximity sensors, basic variant, on Timer 1: see basic_prox.h.
 */
#include "a_d/e_prox.h"

#define PROX_HANDLER _T1Interrupt
#define PROX_CLEAR_FLAG() IFS0bits.T1IF = 0
#define PROX_SET_PERIOD(counts) PR1 = (counts)
#define PROX_STOP() T1CONbits.TON = 0
#define PROX_START()      \
  do {                    \
    T1CON = 0;            \
    T1CONbits.TCKPS = 1;  \
    TMR1 = 0;             \
    PR1 = PULSE_COUNTS;   \
    IFS0bits.T1IF = 0;    \
    IEC0bits.T1IE = 1;    \
    T1CONbits.TON = 1;    \
  } while (0)

#include "basic_prox.h"
