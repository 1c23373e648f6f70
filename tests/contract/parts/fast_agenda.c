/* SPDX-License-Identifier: MIT
 * The agendas on several timers: cycles of 0.1 ms, pause, restart, answers; its motors and LEDs. Timer 5 is the
 * clock here, for the agendas may take 1 to 3. */
#include "say.h"
#include <motor_led/advance_one_timer/fast_agenda/e_agenda_fast.h>
#include <motor_led/advance_one_timer/fast_agenda/e_led.h>
#include <motor_led/advance_one_timer/fast_agenda/e_motors.h>
#include <motor_led/e_epuck_ports.h>

static volatile int calls, others;
static void count(void) { calls++; }
static void count_others(void) { others++; }

/* 1000 at most */
static void wait_ms(unsigned int ms) {
  T5CON = 0;
  TMR5 = 0;
  PR5 = 0xFFFF;
  T5CON = 0x8030;
  while (TMR5 < (unsigned int)(ms * 576ul / 10)) continue;
}

int main(void) {
  begin();
  e_configure_timer(0);
  e_start_agendas_processing();
  e_start_timer_processing(0);
  e_activate_agenda(count, 100);
  e_activate_agenda(count_others, 40);
  calls = others = 0;
  wait_ms(500);
  say("calls", calls);
  say("others", others);
  say("faster", e_set_agenda_cycle(count, 50));
  e_reset_agenda(count);
  calls = 0;
  wait_ms(500);
  say("calls", calls);
  say("pause", e_pause_agenda(count));
  calls = 0;
  wait_ms(100);
  say("paused", calls);
  say("restart", e_restart_agenda(count));
  wait_ms(100);
  say("restarted", calls);
  say("destroyed", e_destroy_agenda(count));
  say("unknown", e_destroy_agenda(count));
  e_set_led(3, 1);
  say("led3", LED3);
  e_blink_led3();
  say("led3", LED3);
  e_led_clear();
  e_set_body_led(1);
  say("body", BODY_LED);
  end();
}
