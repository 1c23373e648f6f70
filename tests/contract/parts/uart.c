/* SPDX-License-Identifier: MIT
 * UART 1 at 115,200 baud: ten bits a byte. */
#include "say.h"

int main(void) {
  static char text[200];
  unsigned int ticks;
  begin();
  memset(text, '.', sizeof text);
  text[199] = '\n';
  pause_ms(2);
  start_clock();
  e_send_uart1_char(text, 200);
  say("busy", e_uart1_sending() != 0);
  start_clock();
  e_send_uart1_char(text, 200);
  while (e_uart1_sending()) continue;
  ticks = TMR1;
  say("ticks", ticks);
  say("idle", e_uart1_sending());
  say("nothing", e_ischar_uart1());
  end();
}
