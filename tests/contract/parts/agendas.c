/* SPDX-License-Identifier: MIT
 * Agendas: cycles of 0.1 ms, pause, restart, answers. */
#include "say.h"
#include <motor_led/advance_one_timer/e_agenda.h>

static volatile int calls, others;
static void count(void) { calls++; }
static void count_others(void) { others++; }
static volatile unsigned int now, before;
static void stamp(void) {
  before = now;
  now = TMR1;
  calls++;
}

/* what was enabled stays so, and nothing else, when the list changes */
static void edits(int tick, int edge) {
  IEC0bits.T2IE = (unsigned int)tick;
  IEC0bits.INT0IE = (unsigned int)edge;
  e_activate_agenda(count, 100);
  e_destroy_agenda(count);
  say("enabled", 10 * IEC0bits.T2IE + IEC0bits.INT0IE);
  IEC0bits.T2IE = IEC0bits.INT0IE = 0;
}

int main(void) {
  begin();
  edits(0, 0);
  edits(0, 1);
  edits(1, 0);
  edits(1, 1);
  e_start_agendas_processing();
  say("new", e_activate_agenda(count, 100));
  e_activate_agenda(count_others, 0);
  pause_ms(500);
  say("calls", calls);
  say("never", others);
  say("faster", e_set_agenda_cycle(count, 50));
  e_reset_agenda(count);
  calls = 0;
  pause_ms(500);
  say("calls", calls);
  e_pause_agenda(count);
  calls = 0;
  pause_ms(100);
  say("paused", calls);
  e_restart_agenda(count);
  pause_ms(100);
  say("restarted", calls);
  say("destroyed", e_destroy_agenda(count));
  say("unknown", e_destroy_agenda(count));
  calls = 0;
  e_activate_agenda(stamp, 40);
  T1CON = 0x8000; /* cycles */
  while (calls < 5) continue;
  say("period", (long)(now - before));
  end();
}
