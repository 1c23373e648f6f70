/* SPDX-License-Identifier: MIT
 * The delay that programs call: a long that is counted up, XC16's 6 cycles a round at -O1 and 13 at -O0. In a file of its
 * own, since many programs have a wait() of theirs.
 * Source: [lib: utility/utility.c], facts restated.
 */
#include "utility/utility.h"

void wait(long num) {
  long i;
  for (i = 0; i < num; i++) continue;
}
