/* SPDX-License-Identifier: MIT */
#include "frame.h"
/* a loop that changes a private variable each round of 10 cycles */
PRIVATE tp_i64 rounds = 0;
void firmware_main(void) {
  for (;;) {
    BLOCK(10);
    ++rounds;
  }
}
