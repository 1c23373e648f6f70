/* SPDX-License-Identifier: MIT
 * Agendas: functions called periodically by one timer. The usual variant.
 *
 * Timer 2, priority 4, ticks every 1475 cycles = 100.03 us. At each tick every active agenda counts; one that
 * has counted its cycle runs, inside the interrupt, newest agenda first. A callback that takes longer than a
 * tick delays all agendas, and ticks missed meanwhile are lost (one is remembered).
 * A callback may change, pause or destroy agendas, its own included.
 * The list is allocated with malloc(); when memory runs out the program ends.
 * Changing the list from the main program races with the interrupt, as on the robot: agendas may be skipped
 * for one tick.
 */
#ifndef __AGENDA_H__
#define __AGENDA_H__

#include "../../twinpuck.h"

#define AG_ALREADY_CREATED 1
#define AG_NOT_FOUND 2

typedef struct AgendaType Agenda;

/** One agenda. */
struct AgendaType {
  unsigned int cycle;     /* ticks between two calls; 0 = never called */
  int counter;            /* ticks counted since the last call */
  char activate;          /* 1 counts, 0 paused */
  void (*function)(void); /* the callback; identifies the agenda */
  Agenda *next;           /* next in the list, or null */
};

/** Starts timer 2. Until then agendas only wait. Does not block. */
void e_start_agendas_processing(void);

/** Stops timer 2; agendas keep their state. */
void e_end_agendas_processing(void);

/** Calls `func` every `cycle` ticks of 0.1 ms from now on: 10000 is once a second; 0 registers without
 *  calling; a negative cycle is taken as unsigned (-1 = 65535). First call one cycle after the activation.
 *  Returns 1. A function that is already registered keeps its old cycle, and the answer is 1 as well. */
int e_activate_agenda(void (*func)(void), int cycle);

/** Forgets the agenda of `func`. Returns 1, or AG_NOT_FOUND (2). */
int e_destroy_agenda(void (*func)(void));

/** New cycle; the counter keeps its value, so a shorter cycle may fire at the next tick. Returns 1, or
 *  AG_NOT_FOUND (2). */
int e_set_agenda_cycle(void (*func)(void), int cycle);

/** Counter to 0: the next call is one full cycle away. Returns 1, or AG_NOT_FOUND (2). */
int e_reset_agenda(void (*func)(void));

/** Stops counting, keeping the counter. Returns 1, or AG_NOT_FOUND (2). */
int e_pause_agenda(void (*func)(void));

/** Counts on after e_pause_agenda(). Returns 1, or AG_NOT_FOUND (2). */
int e_restart_agenda(void (*func)(void));

#endif
