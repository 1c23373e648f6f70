/* SPDX-License-Identifier: MIT
 * Fast agenda: tasks spread over Timers 1 to 3, each timer running at the greatest common divisor of its
 * tasks' cycles, one timer reserved for the two motor tasks. The timers themselves are each HAL's (fast_timers.h).
 *
 *   task of cycle 0 -> waiting list       new task -> a free timer, else the one with the best common divisor
 *
 * Modelled: choice of timer, prescaler and period with their truncations, the timer's count kept over stops,
 * counters that advance by the timer's period, no clearing of the flag for a timer without tasks (it then
 * would interrupt for ever; here it is silent).
 * Not modelled: e_destroy_agenda() of the original unlinks the wrong node; here it unlinks the task's.
 * Source: [lib: motor_led/advance_one_timer/fast_agenda/e_agenda_fast.c], facts restated.
 */
#include "motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h"

#include <stdlib.h>

#include "hal.h"

#define EXIT_OK 1
#define TIMERS 3
#define NO_TIMER (-1)
#define UNIT_CYCLES 1474.56 /* 0.1 ms [lib: motor_led/advance_one_timer/fast_agenda/e_agenda_fast.c] */
#define LONGEST 11459u      /* units that the largest prescaler can hold [lib: the same file] */

static struct AgendaList tasks;

/* one interrupt of a timer: counts its tasks on, and runs those that are due */
static void run_tasks(int index) {
  Agenda* task;
  if (tasks.timers_in_use[index] == 0 || tasks.speed[index] == 0) return;
  for (task = tasks.agendas[index]; task; task = task->next) {
    if (task->activate != 1 || task->cycle == 0) continue;
    task->counter += tasks.speed[index];
    if ((unsigned int)task->counter >= task->cycle) {
      task->function();
      task->counter = 0;
    }
  }
}

#include "fast_timers.h"

/* period of a timer in units of 0.1 ms, with the smallest prescaler that holds it */
static void set_period(int index, unsigned int units) {
  char was_running = timer_runs(index);
  unsigned char shift;
  stop_timer(index);
  if (units > LONGEST) {
    float parts = units / (float)LONGEST;
    unsigned int whole = (unsigned int)parts;
    units = units / (parts > (float)whole ? whole + 1 : whole);
  }
  tasks.speed[index] = units;
  /* below 44 units the library leaves the prescaler of before, which is 1 after configuring */
  shift = units > 2864 ? 8 : units > 358 ? 6 : units >= 44 ? 3 : 0;
  write_period(index, shift, (unsigned int)((unsigned long)(UNIT_CYCLES * units) >> shift));
  if (was_running) start_timer(index);
}

static unsigned int common_divisor(unsigned int a, unsigned int b) {
  while (b != 0) {
    unsigned int rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

/* --- choice of a timer */

static int free_timer(void) {
  int i = tasks.timers_in_use[0] == 0   ? 0
          : tasks.timers_in_use[1] == 0 ? 1
          : tasks.timers_in_use[2] == 0 ? 2
                                        : NO_TIMER;
  return tasks.motors == i ? NO_TIMER : i;
}

/* the busy timer whose period shares most with the cycle; else the one with the longest period */
static int shared_timer(unsigned int cycle, unsigned int* divisor) {
  int i, best = NO_TIMER;
  *divisor = 1;
  for (i = 0; i < TIMERS; i++) {
    unsigned int d = common_divisor(tasks.speed[i], cycle);
    if (tasks.timers_in_use[i] == 0 || tasks.motors == i || d <= *divisor) continue;
    *divisor = d;
    best = i;
  }
  if (best != NO_TIMER) return best;
  best = tasks.motors == 0 ? 1 : 0;
  for (i = 1; i < TIMERS; i++)
    if (tasks.motors != i && tasks.speed[i] < tasks.speed[best]) best = i;
  return best;
}

static void place(Agenda* task) {
  unsigned int divisor = task->cycle;
  int timer = free_timer();
  if (timer != NO_TIMER)
    configure(timer);
  else
    timer = shared_timer(task->cycle, &divisor);
  set_period(timer, divisor);
  task->activate = 1;
  task->next = tasks.agendas[timer];
  tasks.agendas[timer] = task;
  tasks.timers_in_use[timer]++;
}

static Agenda* new_task(void (*func)(void), unsigned cycle) {
  Agenda* task = malloc(sizeof(Agenda));
  if (!task) hal_out_of_memory("e_activate_agenda: no memory left for a task");
  task->cycle = cycle;
  task->counter = 0;
  task->activate = 0;
  task->function = func;
  task->next = 0;
  return task;
}

/* takes the task of `func` out of a list; null if it is not there */
static Agenda* unlink_task(Agenda** list, void (*func)(void)) {
  for (; *list; list = &(*list)->next)
    if ((*list)->function == func) {
      Agenda* task = *list;
      *list = task->next;
      task->next = 0;
      return task;
    }
  return 0;
}

static Agenda* find_in(Agenda* list, void (*func)(void)) {
  while (list && list->function != func) list = list->next;
  return list;
}

/* the timer that serves the task of `func` */
static int timer_of(void (*func)(void)) {
  if (find_in(tasks.agendas[0], func)) return 0;
  if (find_in(tasks.agendas[1], func)) return 1;
  return find_in(tasks.agendas[2], func) ? 2 : NO_TIMER;
}

static Agenda* find_task(void (*func)(void)) {
  int timer = timer_of(func);
  return find_in(timer == NO_TIMER ? tasks.waiting : tasks.agendas[timer], func);
}

/* --- the API */

void e_start_agendas_processing(void) {
  int i;
  for (i = 0; i < TIMERS; i++) {
    tasks.agendas[i] = 0;
    tasks.speed[i] = 1;
    tasks.timers_in_use[i] = 0;
  }
  tasks.waiting = 0;
  tasks.motors = NO_TIMER;
}

void e_configure_timer(int timer) {
  int i;
  for (i = 0; i < TIMERS; i++)
    if (timer == 0 || timer == i + 1) configure(i);
}

void e_start_timer_processing(int timer) {
  int i;
  for (i = 0; i < TIMERS; i++)
    if ((timer == 0 || timer == i + 1) && tasks.timers_in_use[i] > 0) start_timer(i);
}

void e_end_agendas_processing(int timer) {
  int i;
  for (i = 0; i < TIMERS; i++)
    if (timer == 0 || timer == i + 1) stop_timer(i);
}

void e_activate_agenda(void (*func)(void), unsigned cycle) {
  Agenda* task = new_task(func, cycle);
  e_end_agendas_processing(0);
  if (cycle > 0) {
    place(task);
  } else {
    task->next = tasks.waiting;
    tasks.waiting = task;
  }
  e_start_timer_processing(0);
}

void e_activate_motors(void (*func1)(void), void (*func2)(void)) {
  Agenda* first = new_task(func1, 0);
  int i, timer = 0;
  e_end_agendas_processing(0);
  /* a timer without tasks, else the one with the fewest, whose tasks move elsewhere */
  for (i = 1; i < TIMERS; i++)
    if (tasks.timers_in_use[i] < tasks.timers_in_use[timer]) timer = i;
  tasks.motors = (char)timer;
  if (tasks.timers_in_use[timer] > 0) {
    Agenda* task = tasks.agendas[timer];
    tasks.agendas[timer] = 0;
    while (task) {
      Agenda* next = task->next;
      place(task);
      task = next;
    }
    tasks.timers_in_use[timer] = 0;
    tasks.speed[timer] = 1;
  }
  configure(timer);
  first->activate = 1;
  first->next = new_task(func2, 0);
  first->next->activate = 1;
  tasks.agendas[timer] = first;
  tasks.timers_in_use[timer] += 2;
  e_start_timer_processing(0);
}

int e_set_motor_speed(void (*func)(void), unsigned cycle) {
  Agenda* task;
  unsigned int other;
  if (tasks.motors < 0) return AG_NOT_FOUND;
  task = find_in(tasks.agendas[(int)tasks.motors], func);
  if (!task) return AG_NOT_FOUND;
  e_end_agendas_processing(tasks.motors + 1);
  other = task->next ? task->next->cycle : tasks.speed[(int)tasks.motors];
  set_period(tasks.motors, common_divisor(other, cycle));
  task->cycle = cycle;
  e_start_timer_processing(tasks.motors + 1);
  return EXIT_OK;
}

int e_destroy_agenda(void (*func)(void)) {
  int i;
  for (i = 0; i < TIMERS; i++) {
    Agenda* task = unlink_task(&tasks.agendas[i], func);
    if (!task) continue;
    free(task);
    tasks.timers_in_use[i]--;
    return EXIT_OK;
  }
  return AG_NOT_FOUND;
}

int e_set_agenda_cycle(void (*func)(void), unsigned cycle) {
  Agenda* task;
  int i;
  e_end_agendas_processing(0);
  if (cycle > 0 && (task = unlink_task(&tasks.waiting, func)) != 0) {
    task->cycle = cycle;
    place(task);
    e_start_timer_processing(0);
    return EXIT_OK;
  }
  i = timer_of(func);
  if (i == NO_TIMER) {
    e_start_timer_processing(0);
    return AG_NOT_FOUND;
  }
  task = find_in(tasks.agendas[i], func);
  if (cycle == 0) {
    unlink_task(&tasks.agendas[i], func);
    tasks.timers_in_use[i]--;
    task->activate = 0;
    task->next = tasks.waiting;
    tasks.waiting = task;
  } else {
    set_period(i, common_divisor(cycle, tasks.speed[i]));
  }
  task->cycle = cycle;
  e_start_timer_processing(0);
  return EXIT_OK;
}

int e_reset_agenda(void (*func)(void)) {
  Agenda* task = find_task(func);
  if (!task) return AG_NOT_FOUND;
  task->counter = 0;
  return EXIT_OK;
}

int e_pause_agenda(void (*func)(void)) {
  Agenda* task = find_task(func);
  if (!task) return AG_NOT_FOUND;
  task->activate = 0;
  return EXIT_OK;
}

int e_restart_agenda(void (*func)(void)) {
  Agenda* task = find_task(func);
  if (!task) return AG_NOT_FOUND;
  task->activate = 1;
  return EXIT_OK;
}
