/* SPDX-License-Identifier: MIT
 * Firmware libc: signals. One without a handler ends the program, as abort() does. */
#include <signal.h>
#include <stdlib.h>

enum { kSignals = 16 };

typedef void (*Handler)(int);
static Handler handlers[kSignals];

Handler signal(int number, Handler handler)
{
  Handler before;
  if (number <= 0 || number >= kSignals) return SIG_ERR;
  before = handlers[number];
  handlers[number] = handler;
  return before;
}

int raise(int number)
{
  Handler handler;
  if (number <= 0 || number >= kSignals) return -1;
  handler = handlers[number];
  if (handler == SIG_IGN) return 0;
  if (handler == SIG_DFL) abort();
  handlers[number] = SIG_DFL; /* it serves one signal [C99 7.14.1.1] */
  handler(number);
  return 0;
}
