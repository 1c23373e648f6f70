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

/* state: five words of __builtin_setjmp(), the first of them the frame, and who called the function of that frame,
 * which stands above the frame's first word, that of the frame before */
int tp_image_note_caller(void *state)
{
  ((void **)state)[5] = ((void ***)state)[0][1];
  return 0;
}

void tp_image_longjmp(void *state, int *value, int v)
{
  void *own[5], **target = ((void ***)state)[0], **frame;
  __builtin_setjmp(own);
  frame = own[0];
  *value = v ? v : 1;
  /* the function that called setjmp() must be one of those that led here */
  while (frame < target && (void **)frame[0] > frame) frame = frame[0];
  if (frame != target || target[1] != ((void **)state)[5])
    tp_trap_message(TP_TRAP_UNSIMULATED,
                    "longjmp() to a function that has returned, or to a place that setjmp() has not set; programs that "
                    "exchange stacks so (processes, coroutines) run on the robot only");
  __builtin_longjmp(state, 1);
}

void __delay32(unsigned long cycles) { tp_spend(cycles); }
