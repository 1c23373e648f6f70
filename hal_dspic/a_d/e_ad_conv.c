/* SPDX-License-Identifier: MIT
 * Single conversions by the program itself: sample, convert, wait, about 30 us.
 * Source: [lib: a_d/e_ad_conv.c], facts restated; [DS70143 20].
 */
#include "a_d/e_ad_conv.h"

#include "motor_led/e_epuck_ports.h"

#define LAST_CHANNEL 15
#define CLOCK (int)(2 * 667 / TCY_PIC - 1) /* TAD not below 667 ns */
#define SAMPLING_ROUNDS 40

void e_init_ad(void) {
  ADCON1 = 0; /* off; the program starts sampling and conversion; whole numbers */
  IEC0bits.ADIE = 0;
  ADCON2 = 0;
  ADCON3 = CLOCK;
  ADCHS = 0;
  ADPCFG = 0x0003; /* AN0 and AN1 are the debugger's */
  ADCSSL = 0;
  ADCON1bits.ADON = 1;
}

int e_read_ad(unsigned int channel) {
  int round;
  if (channel > LAST_CHANNEL) return 0;
  ADCHS = channel;
  ADCON1bits.DONE = 0;
  ADCON1bits.SAMP = 1;
  for (round = 0; round < SAMPLING_ROUNDS; round++) NOP();
  ADCON1bits.SAMP = 0;
  while (!ADCON1bits.DONE) continue;
  IFS0bits.ADIF = 0;
  return (int)ADCBUF0;
}
