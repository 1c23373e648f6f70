/* SPDX-License-Identifier: MIT */
#include "frame.h"
#include <string.h>
/* one way to fail for each value of `choice`, which the test sets before power-up through the start value */
PRIVATE volatile tp_i64 choice = TP_TEST_CHOICE;
volatile tp_i64 sink;
__attribute__((noinline)) static tp_i64 recurse(tp_i64 n) {
  volatile char frame[200];
  BLOCK(20);
  frame[0] = (char)n;
  return recurse(n + 1) + frame[0];
}
static void never(void) {}
__attribute__((noinline)) static void fail(void) {
  BLOCK(100);
  switch (choice) {
    case 1: sink = *(volatile tp_i64*)0; break;
    case 2: *(volatile tp_i64*)0xdeadbeefcafe0000 = 1; break;
    case 3: *(volatile char*)0x1234 = 1; break;
    case 4: tp_trap(TP_TRAP_MATH); break;
    case 5: sink = recurse(0); break;
    case 6: tp_trap(TP_TRAP_ABORT); break;
    case 7:
      tp_irq_install(TP_V_T2, never, 4, 20);
      tp_irq_at(TP_V_T2, tp_now() + 1000);
      for (;;) {
        BLOCK(3);
        tp_disi(10000);
      }
    case 8: ((void (*)(void))0x10)(); break;
    case 9: __builtin_trap(); break;
    case 10: memset((void*)16, 1, 4000); break;
    case 11: tp_sfr_write(0x2A0, 0x8000, 16); break;
    case 12: return;
    default: break;
  }
}
void firmware_main(void) {
  BLOCK(1000);
  fail();
}
