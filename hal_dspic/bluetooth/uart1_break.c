/* SPDX-License-Identifier: MIT
 * A break to the Bluetooth module: UART 1's transmitter lets its pin go, and the port holds the line low.
 * Source: [lib: bluetooth/e_bluetooth.c], facts restated.
 */
#include "hal.h"

#define BREAK_PAUSES 25
#define PAUSE_ROUNDS 15040 /* 25 of them at -O1: 1,504,000 cycles, 102 ms */

void hal_uart1_break(void) {
  int i;
  U1MODEbits.UARTEN = 0;
  LATFbits.LATF3 = 0;
  TRISFbits.TRISF3 = 0;
  for (i = 0; i < BREAK_PAUSES; i++) hal_pause(PAUSE_ROUNDS);
  LATFbits.LATF3 = 1;
}
