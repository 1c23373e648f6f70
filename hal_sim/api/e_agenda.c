/* SPDX-License-Identifier: MIT
 * Agendas, usual variant. The list and the counting are the board's (hal_sim/board/agenda_timer.h): the
 * interrupt comes only at ticks at which a callback is due, and finds all counters where 10,000 ticks a
 * second would have left them.
 * Not modelled: the heap that the nodes take, and the end of the program when it is full.
 * Source: [lib: motor_led/advance_one_timer/e_agenda.c], facts restated.
 */
#include "motor_led/advance_one_timer/e_agenda.h"

#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"

#define TIMER2_PRIORITY 4   /* reset value of IPC1 [DS70143 5.2] */
#define TIMER2_ENTRY_CYCLES 15 /* beside the walk's own [measured: register way, tick to first callback] */

/* Timer 2 interrupt: newest agenda first; what a callback does to the list counts at once */
static void serve_timer2(void) {
  void (*callback)(void);
  tp_agenda_begin();
  while ((callback = (void (*)(void))tp_agenda_next()) != 0) callback();
  tp_agenda_end();
}

TAKES(T_AGENDAS_START) void e_start_agendas_processing(void) {
  tp_irq_install(TP_V_T2, serve_timer2, TIMER2_PRIORITY, TIMER2_ENTRY_CYCLES);
  tp_agenda_start();
}

TAKES(T_AGENDAS_STOP) void e_end_agendas_processing(void) { tp_agenda_stop(); }

int e_activate_agenda(void (*func)(void), int cycle) {
  return (int)tp_agenda_activate((const void *)func, cycle);
}

int e_destroy_agenda(void (*func)(void)) { return (int)tp_agenda_destroy((const void *)func); }

int e_set_agenda_cycle(void (*func)(void), int cycle) {
  return (int)tp_agenda_set_cycle((const void *)func, cycle);
}

int e_reset_agenda(void (*func)(void)) { return (int)tp_agenda_reset((const void *)func); }

int e_pause_agenda(void (*func)(void)) { return (int)tp_agenda_pause((const void *)func); }

int e_restart_agenda(void (*func)(void)) { return (int)tp_agenda_restart((const void *)func); }
