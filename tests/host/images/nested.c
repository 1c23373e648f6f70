/* SPDX-License-Identifier: MIT */
#include "frame.h"
/* priority 4 handler that takes long, priority 6 handler that interrupts it, priority 4 second source that waits */
PRIVATE tp_i64 log_count = 0;
PRIVATE char log_text[32] = "";
static void note(char c) { if (log_count < 31) log_text[log_count++] = c; }
static void low(void) {
  int i;
  note('a');
  for (i = 0; i < 1000; ++i) BLOCK(10);
  note('A');
}
static void equal(void) { BLOCK(1); note('e'); }
static void high(void) { BLOCK(1); note('h'); }
void firmware_main(void) {
  tp_irq_install(TP_V_T2, low, 4, 20);
  tp_irq_install(TP_V_T4, equal, 4, 20);
  tp_irq_install(TP_V_U1RX, high, 6, 20);
  tp_irq_at(TP_V_T2, 10000);
  tp_irq_at(TP_V_T4, 12000);
  tp_irq_at(TP_V_U1RX, 13000);
  for (;;) {
    BLOCK(2);
    tp_poll(1);
  }
}
