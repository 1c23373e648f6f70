/* SPDX-License-Identifier: MIT
 * Agendas, usual variant: Timer 2 every 1475 cycles (100.03 us), priority 4, newest agenda first.
 *
 * The main program edits the list while the interrupt walks it, so edits hold it off. Callbacks edit it too,
 * from inside the walk: the walk keeps what it needs (`hal_running_agenda`, `following`) where the edits can correct it. In the
 * original an agenda that destroys itself is written to after it was freed; here it is not.
 * Source: [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
 */
#include "motor_led/advance_one_timer/e_agenda.h"

#include <stdlib.h>

#include "hal.h"

#define EXIT_OK 1
#define TICK_COUNTS 1474 /* 0.1 ms are 1474.56 cycles, truncated; the period is one more */

/* While the list and the heap change, neither the tick nor the remote control's edge may come; they wait. Everything else
 * goes on: malloc() takes long, and the converter's interrupt must not wait for it. */
struct held {
  unsigned char tick, edge;
};

static struct held hold(void) {
  struct held before;
  before.tick = IEC0bits.T2IE;
  before.edge = IEC0bits.INT0IE;
  IEC0bits.T2IE = 0;
  IEC0bits.INT0IE = 0;
  return before;
}

static void release(struct held before) {
  if (before.tick) IEC0bits.T2IE = 1;
  if (before.edge) IEC0bits.INT0IE = 1;
}

static Agenda *volatile agendas;
Agenda *volatile hal_running_agenda; /* whose callback runs; null when that agenda has been destroyed */
static Agenda *volatile following; /* next one of the walk */

void __attribute__((__interrupt__, __auto_psv__)) _T2Interrupt(void) {
  Agenda *agenda;
  IFS0bits.T2IF = 0;
  for (agenda = agendas; agenda; agenda = following) {
    following = agenda->next;
    if (agenda->activate != 1 || agenda->cycle == 0) continue;
    agenda->counter++;
    if ((unsigned int)agenda->counter < agenda->cycle) continue;
    hal_running_agenda = agenda;
    agenda->function();
    if (hal_running_agenda) hal_running_agenda->counter = 0;
    hal_running_agenda = 0;
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
  struct held before;
  if (find(func)) return AG_ALREADY_CREATED;
  before = hold();
  agenda = new_agenda(func, cycle);
  agenda->next = agendas;
  agendas = agenda;
  release(before);
  return EXIT_OK;
}

int e_destroy_agenda(void (*func)(void)) {
  Agenda *doomed, *before;
  struct held enabled;
  int result = AG_NOT_FOUND;
  enabled = hold();
  doomed = find(func);
  if (doomed) {
    if (agendas == doomed) {
      agendas = doomed->next;
    } else {
      for (before = agendas; before->next != doomed; before = before->next) continue;
      before->next = doomed->next;
    }
    if (hal_running_agenda == doomed) hal_running_agenda = 0;
    if (following == doomed) following = doomed->next;
    free(doomed);
    result = EXIT_OK;
  }
  release(enabled);
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
