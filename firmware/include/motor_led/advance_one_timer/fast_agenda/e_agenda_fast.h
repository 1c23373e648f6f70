/* SPDX-License-Identifier: MIT
 * Agendas spread over timers 1, 2 and 3, so that each timer ticks only as often as its tasks need. Rarely
 * used.
 *
 * Each timer's period is the greatest common divisor of its tasks' cycles, in units of 0.1 ms (1475 cycles).
 * A timer can be reserved for the two motor tasks. Tasks of cycle 0 wait in a list of their own.
 * Interrupts have priority 4. Nothing here blocks.
 * Do not mix with e_agenda.h: the names are the same, some prototypes are not.
 */
#ifndef __AGENDA_FAST_H__
#define __AGENDA_FAST_H__

#include "../../../twinpuck.h"

#define AG_ALREADY_CREATED 1
#define AG_NOT_FOUND 2

typedef struct AgendaType Agenda;

/** One task; as in e_agenda.h. */
struct AgendaType {
  unsigned int cycle;     /* units of 0.1 ms between two calls; 0 = never called */
  int counter;            /* counted since the last call */
  char activate;          /* 1 counts, 0 paused */
  void (*function)(void); /* the callback; identifies the task */
  Agenda *next;           /* next in the list, or null */
};

/** All tasks. */
struct AgendaList {
  char motors;                    /* timer reserved for the motors, or none */
  Agenda *waiting;                /* tasks of cycle 0 */
  Agenda *agendas[3];             /* tasks of timers 1, 2, 3 */
  unsigned char timers_in_use[3]; /* 1 where the timer runs */
  unsigned speed[3];              /* period of the timers, 0.1 ms */
};

/** Empties the lists. Starts nothing: see e_start_timer_processing(). */
void e_start_agendas_processing(void) TP_VARIANT(tpfast_, e_start_agendas_processing);

/** Starts timer 1, 2 or 3; 0 starts all three. */
void e_start_timer_processing(int timer) TP_VARIANT(tpfast_, e_start_timer_processing);

/** Stops timer 1, 2 or 3; 0 stops all three. */
void e_end_agendas_processing(int timer) TP_VARIANT(tpfast_, e_end_agendas_processing);

/** Prescaler 1, period 0.1 ms, interrupt off and on again, for timer 1, 2 or 3; 0 means all three. */
void e_configure_timer(int timer) TP_VARIANT(tpfast_, e_configure_timer);

/** Calls `func` every `cycle` x 0.1 ms from now on, on the timer that suits the cycle best. */
void e_activate_agenda(void (*func)(void), unsigned cycle) TP_VARIANT(tpfast_, e_activate_agenda);

/** Reserves a timer for the two motor tasks. */
void e_activate_motors(void (*func1)(void), void (*func2)(void)) TP_VARIANT(tpfast_, e_activate_motors);

/** New cycle of a motor task. Returns 1, or AG_NOT_FOUND (2). */
int e_set_motor_speed(void (*func)(void), unsigned cycle) TP_VARIANT(tpfast_, e_set_motor_speed);

/** Each returns 1, or AG_NOT_FOUND (2); meaning as in e_agenda.h. */
int e_destroy_agenda(void (*func)(void)) TP_VARIANT(tpfast_, e_destroy_agenda);
int e_set_agenda_cycle(void (*func)(void), unsigned cycle) TP_VARIANT(tpfast_, e_set_agenda_cycle);
int e_reset_agenda(void (*func)(void)) TP_VARIANT(tpfast_, e_reset_agenda);
int e_pause_agenda(void (*func)(void)) TP_VARIANT(tpfast_, e_pause_agenda);
int e_restart_agenda(void (*func)(void)) TP_VARIANT(tpfast_, e_restart_agenda);

#endif
