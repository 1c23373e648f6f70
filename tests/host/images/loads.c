/* SPDX-License-Identifier: MIT
 * Code that a dynamic linker would run while it loads the image. */
#include <unistd.h>

#include "frame.h"

#ifdef TP_TEST_CONSTRUCTOR
__attribute__((constructor)) static void begin(void) { _exit(99); }
#endif
#ifdef TP_TEST_IFUNC
static void one(void) {}
static void (*choose(void))(void) { _exit(98); return one; }
void chosen(void) __attribute__((ifunc("choose")));
#endif

void firmware_main(void) {
#ifdef TP_TEST_IFUNC
  chosen();
#endif
  for (;;) BLOCK(1000);
}
