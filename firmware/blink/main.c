/* SPDX-License-Identifier: MIT
 * Blink: the shortest program with an agenda. main() does nothing; timer 2 does it all.
 */
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/e_init_port.h>

#define PERIOD 1000 /* agenda ticks of 0.1 ms */

/* Runs inside the timer's interrupt: keep it short. */
static void toggle(void) { e_set_led(0, 2); }

int main(void) {
  e_init_port();
  e_start_agendas_processing();
  e_activate_agenda(toggle, PERIOD);
  while (1);
}
