// SPDX-License-Identifier: MIT
/* events: list of events with time and kind; takes out those that are due. */
#ifndef NOINLINE
#define NOINLINE __attribute__((noinline))
#endif

struct event {
  unsigned int due;
  char kind;
  struct event* next;
};
static struct event third = {900, 'c', 0}, second = {400, 'b', &third}, first = {100, 'a', &second};
static struct event* waiting = &first;
NOINLINE int events(unsigned int now) {
  struct event** at = &waiting;
  int sum = 0;
  while (*at) {
    struct event* e = *at;
    if (e->due <= now) {
      sum += e->kind;
      *at = e->next;
    } else {
      at = &e->next;
    }
  }
  return sum;
}

/* fixed driver input */
long bench_run(void) {
  long a = events(50);
  a = a * 3 + events(450);
  return a * 3 + events(1000);
}
