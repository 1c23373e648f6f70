/* SPDX-License-Identifier: MIT */
#include "frame.h"
/* Timer 1 by registers: prescale 8, period 18432 ticks of 8 cycles = 147,456 cycles = 10 ms; the handler toggles LED 0
 * (LATA bit 6) and clears T1IF itself. Timer 3 is polled through its flag. */
PRIVATE tp_i64 fired = 0;
void _T1Interrupt(void) {
  BLOCK(4);
  tp_sfr_write(0x084, tp_sfr_read(0x084, 16) & ~8, 16); /* IFS0.T1IF = 0 */
  tp_sfr_write(0x2C4, tp_sfr_read(0x2C4, 16) ^ 0x40, 16);
  ++fired;
}
void firmware_main(void) {
  tp_sfr_write(0x2C0, 0, 16);     /* TRISA: outputs */
  tp_sfr_write(0x102, 18431, 16); /* PR1 */
  tp_sfr_write(0x100, 0, 16);
  tp_sfr_write(0x08C, 8, 16);      /* IEC0.T1IE */
  tp_sfr_write(0x104, 0x8010, 16); /* TON, prescale 8 */
  for (;;) {
    BLOCK(2);
    tp_poll(1);
  }
}
