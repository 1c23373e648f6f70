/* SPDX-License-Identifier: MIT */
#include "frame.h"
/* an API timer every 147,456 cycles (10 ms); the handler notes when it ran and asks again */
PRIVATE tp_i64 ticks = 0, worst_late = 0, due = 0;
static void on_tick(void) {
  tp_i64 late;
  BLOCK(5);
  late = tp_now() - due;
  if (late > worst_late) worst_late = late;
  ++ticks;
  due += 147456;
  tp_irq_at(TP_V_T2, due);
}
void firmware_main(void) {
  tp_irq_install(TP_V_T2, on_tick, 4, 20);
  due = 147456;
  tp_irq_at(TP_V_T2, due);
  for (;;) {
    BLOCK(2);
    tp_poll(1);
  }
}
