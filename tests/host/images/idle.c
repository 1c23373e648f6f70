/* SPDX-License-Identifier: MIT */
#include "frame.h"
/* while(1); with a private counter */
PRIVATE tp_i64 started = 41;
void firmware_main(void) {
  ++started;
  for (;;) {
    BLOCK(2);
    tp_poll(1);
  }
}
