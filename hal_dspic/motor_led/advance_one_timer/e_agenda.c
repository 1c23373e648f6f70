/* SPDX-License-Identifier: MIT
 * Agendas, usual variant: Timer 2 every 1475 cycles (100.03 us), priority 4, newest agenda first.
 *
 * The main program edits the list while the interrupt walks it, so edits run at priority 4. Callbacks edit it too,
 * from inside the walk: the walk keeps what it needs (`running`, `following`) where the edits can correct it. In the
 * original an agenda that destroys itself is written to after it was freed; here it is not.
 * Source: [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
 */
#include "motor_led/advance_one_timer/e_agenda.h"

#include <stdlib.h>

#include "hal.h"

#define EXIT_OK 1
#define TICK_COUNTS 1474 /* 0.1 ms are 1474.56 cycles, truncated; the period is one more */
#define TIMER_PRIORITY 4

/* list edits wait for no tick, and no tick comes into them; a caller of higher priority keeps it */
#define HOLD_TICKS(saved)                                        \
  do {                                                           \
    saved = SRbits.IPL;                                          \
    if (saved < TIMER_PRIORITY) SRbits.IPL = TIMER_PRIORITY;     \
  } while (0)
#define RELEASE_TICKS(saved) SRbits.IPL = (unsigned int)(saved)

static Agenda *volatile agendas;
static Agenda *volatile running;   /* whose callback runs; null when that agenda has been destroyed */
static Agenda *volatile following; /* next one of the walk */

void __attribute__((__interrupt__, __auto_psv__)) _T2Interrupt(void) {
  Agenda *agenda;
  IFS0bits.T2IF = 0;
  for (agenda = agendas; agenda; agenda = following) {
    following = agenda->next;
    if (agenda->activate != 1 || agenda->cycle == 0) continue;
    agenda->counter++;
    if ((unsigned int)agenda->counter < agenda->cycle) continue;
    running = agenda;
    agenda->function();
    if (running) running->counter = 0;
    running = 0;
  }
}

void e_start_agendas_processing(void) {
  T2CON = 0;
  TMR2 = 0;
  PR2 = TICK_COUNTS;
  IFS0bits.T2IF = 0;
  IEC0bits.T2IE = 1;
  T2CONbits.TON = 1;
}

void e_end_agendas_processing(void) { T2CONbits.TON = 0; }

static Agenda *find(void (*func)(void)) {
  Agenda *agenda = agendas;
  while (agenda && agenda->function != func) agenda = agenda->next;
  return agenda;
}

static Agenda *new_agenda(void (*func)(void), int cycle) {
  Agenda *agenda = malloc(sizeof(Agenda));
  if (!agenda) hal_out_of_memory("e_activate_agenda: no memory left for an agenda");
  agenda->cycle = (unsigned int)cycle;
  agenda->counter = 0;
  agenda->activate = 1;
  agenda->function = func;
  return agenda;
}

int e_activate_agenda(void (*func)(void), int cycle) {
  Agenda *agenda;
  int saved;
  if (find(func)) return AG_ALREADY_CREATED;
  HOLD_TICKS(saved);
  agenda = new_agenda(func, cycle);
  agenda->next = agendas;
  agendas = agenda;
  RELEASE_TICKS(saved);
  return EXIT_OK;
}

int e_destroy_agenda(void (*func)(void)) {
  Agenda *doomed, *before;
  int saved, result = AG_NOT_FOUND;
  HOLD_TICKS(saved);
  doomed = find(func);
  if (doomed) {
    if (agendas == doomed) {
      agendas = doomed->next;
    } else {
      for (before = agendas; before->next != doomed; before = before->next) continue;
      before->next = doomed->next;
    }
    if (running == doomed) running = 0;
    if (following == doomed) following = doomed->next;
    free(doomed);
    result = EXIT_OK;
  }
  RELEASE_TICKS(saved);
  return result;
}

int e_set_agenda_cycle(void (*func)(void), int cycle) {
  Agenda *agenda = find(func);
  if (!agenda) return AG_NOT_FOUND;
  agenda->cycle = (unsigned int)cycle;
  return EXIT_OK;
}

int e_reset_agenda(void (*func)(void)) {
  Agenda *agenda = find(func);
  if (!agenda) return AG_NOT_FOUND;
  agenda->counter = 0;
  return EXIT_OK;
}

int e_pause_agenda(void (*func)(void)) {
  Agenda *agenda = find(func);
  if (!agenda) return AG_NOT_FOUND;
  agenda->activate = 0;
  return EXIT_OK;
}

int e_restart_agenda(void (*func)(void)) {
  Agenda *agenda = find(func);
  if (!agenda) return AG_NOT_FOUND;
  agenda->activate = 1;
  return EXIT_OK;
}
