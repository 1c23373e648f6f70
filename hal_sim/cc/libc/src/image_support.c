/* SPDX-License-Identifier: MIT
 * Firmware libc: what headers of the libc call behind the scenes. */
#include <stdio.h>
#include "hal_sim/host/image_abi.h"
#include "hal_sim/host/pins.h"

/* failed assert(): file:line and the condition go into the report */
void tp_image_assert(const char *file, int line, const char *text)
{
  char message[160];
  snprintf(message, sizeof message, "%s:%d: assert(%s) failed", file, line, text);
  tp_trap_message(TP_TRAP_ABORT, message);
}

void tp_image_longjmp(void *state, int *value, int v)
{
  *value = v ? v : 1;
  /* the frame that called setjmp() must still be there: above ours, for stacks grow downwards */
  if (((void **)state)[2] < __builtin_frame_address(0))
    tp_trap_message(TP_TRAP_UNSIMULATED,
                    "longjmp() to a function that has returned, or to a place that setjmp() has not set; programs that "
                    "exchange stacks so (processes, coroutines) run on the robot only");
  __builtin_longjmp(state, 1);
}

void __delay32(unsigned long cycles) { tp_spend(cycles); }
