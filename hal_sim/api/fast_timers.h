/* SPDX-License-Identifier: MIT
 * Timers 1 to 3 for the fast agenda (firmware/library/e_agenda_fast.c, its only includer), the native way:
 * interrupts are not evaluated in closed form but delivered one by one.
 */
#ifndef TWINPUCK_API_FAST_TIMERS_H
#define TWINPUCK_API_FAST_TIMERS_H

#include "hal_sim/api/timings.h"
#include "hal_sim/host/pins.h"

/* part of the functions that call it, charged as they are */
#define INTO_CALLER inline __attribute__((always_inline))

#define TIMER_PRIORITY 4

/* one hardware timer */
struct timer {
  tp_i64 vector;
  unsigned int period; /* PR register */
  unsigned char shift; /* prescaler as a power of two: 0, 3, 6, 8 */
  char running;
  char pending;       /* matched, interrupt not served yet */
  unsigned int count; /* TMR register while stopped */
  tp_i64 started;     /* cycle at which it was started with that count */
  tp_i64 served;      /* cycle of the latest interrupt since then */
};

static struct timer timers[TIMERS] = {{TP_V_T1, 65535u, 0, 0, 0, 0, 0, 0},
                                      {TP_V_T2, 65535u, 0, 0, 0, 0, 0, 0},
                                      {TP_V_T3, 65535u, 0, 0, 0, 0, 0, 0}};

/* counts from the start to the first match; a count beyond the period first runs through 16 bits */
static INTO_CALLER tp_i64 first_match(const struct timer* t) {
  tp_i64 to_go = (tp_i64)t->period + 1 - t->count;
  return to_go <= 0 ? to_go + 65536 : to_go;
}

/* matches between the start and the cycle `at`, and the count that the timer then has */
static INTO_CALLER tp_i64 matches_until(const struct timer* t, tp_i64 at, unsigned int* count) {
  tp_i64 counts = (at - t->started) >> t->shift, first = first_match(t);
  if (counts < first) {
    *count = (unsigned int)(t->count + counts);
    return 0;
  }
  counts -= first;
  *count = (unsigned int)(counts % ((tp_i64)t->period + 1));
  return 1 + counts / ((tp_i64)t->period + 1);
}

static INTO_CALLER void request_matches(struct timer* t) {
  if (tasks.speed[t - timers] == 0)
    tp_irq_at(t->vector, -1); /* a timer whose tasks all rest */
  else
    tp_irq_every(t->vector, t->started + (first_match(t) << t->shift), ((tp_i64)t->period + 1) << t->shift);
}

/* What the timers' bookkeeping takes is not the robot's: there it is a bit of a register. Names with
 * tp_image_ are not charged, and the callers add what the access takes. */
#define REGISTER_CYCLES 12 /* call, choice of the timer, one bit, return [measured: the register way] */
void tp_image_start_timer(int index);
void tp_image_stop_timer(int index);
void tp_image_timer_served(int index);

void __attribute__((noinline)) tp_image_start_timer(int index) {
  struct timer* t = &timers[index];
  if (t->running) return;
  t->running = 1;
  t->started = t->served = tp_now();
  if (t->pending)
    tp_irq_at(t->vector, t->started);
  else
    request_matches(t);
}

void __attribute__((noinline)) tp_image_stop_timer(int index) {
  struct timer* t = &timers[index];
  unsigned int count, then;
  if (!t->running) return;
  /* another handler held up this one: the count has gone on from 0, the flag stays */
  if (matches_until(t, tp_now(), &count) > matches_until(t, t->served, &then) && tasks.speed[t - timers] > 0)
    t->pending = 1;
  t->count = count;
  t->running = 0;
  tp_irq_at(t->vector, -1);
}

static void start_timer(int index) {
  tp_spend(REGISTER_CYCLES);
  tp_image_start_timer(index);
}

static void stop_timer(int index) {
  tp_spend(REGISTER_CYCLES);
  tp_image_stop_timer(index);
}

void __attribute__((noinline)) tp_image_timer_served(int index) {
  struct timer* t = &timers[index];
  t->served = tp_now();
  if (t->pending) {
    t->pending = 0;
    request_matches(t);
  }
}

static void serve(int index) {
  tp_image_timer_served(index);
  run_tasks(index);
}

static void serve_timer1(void) { serve(0); }
static void serve_timer2(void) { serve(1); }
static void serve_timer3(void) { serve(2); }

static void configure(int index) {
  static void (*const handlers[TIMERS])(void) = {serve_timer1, serve_timer2, serve_timer3};
  struct timer* t = &timers[index];
  stop_timer(index);
  t->shift = 0;
  t->count = 0;
  t->pending = 0;
  t->period = (unsigned int)UNIT_CYCLES;
  tp_irq_install(t->vector, handlers[index], TIMER_PRIORITY, T_FAST_TIMER);
}

static char timer_runs(int index) { return timers[index].running; }

static void write_period(int index, unsigned char shift, unsigned int period) {
  timers[index].shift = shift;
  timers[index].period = period;
}

#endif
