/* SPDX-License-Identifier: MIT
 * The remote control's receiver on RF6: external interrupt 0, falling edge.
 */
#include "hal.h"

void __attribute__((__interrupt__, __auto_psv__)) _INT0Interrupt(void) {
  IFS0bits.INT0IF = 0;
  hal_remote_edge();
}

void hal_remote_arm(void) {
  INTCON2bits.INT0EP = 1;
  IFS0bits.INT0IF = 0;
  IEC0bits.INT0IE = 1;
}

void hal_remote_disarm(void) { IEC0bits.INT0IE = 0; }
