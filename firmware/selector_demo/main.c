/* SPDX-License-Identifier: MIT
 * Selector demo: one program, several behaviours, chosen by the rotary switch, as in the robot's own demonstration
 * program. The position is read once after a reset.
 */
#include <p30F6014A.h>

#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <stdio.h>
#include <string.h>
#include <uart/e_uart_char.h>
#include <utility/utility.h>

/* Each behaviour starts its agendas and returns; the timer does the rest. */

static void running_light(void) { e_activate_agenda(snake_led, 1000); }

static void blinking_ring(void) { e_start_led_blinking(5000); }

static void drive_straight(void) {
  e_set_speed_left(300);
  e_set_speed_right(300);
}

static void spin(void) { e_set_speed(0, 200); }

static void show_position(int position) {
  e_set_led(position & 7, 1);
  e_set_body_led(position > 7);
}

int main(void) {
  static char text[32]; /* static: it is sent from here after main has gone on */
  int position;
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_uart1();

  /* after power-up, start a second time: the usual cure for peripherals that were not ready */
  if (RCONbits.POR) {
    RCONbits.POR = 0;
    RESET();
  }

  position = getselector();
  sprintf(text, "selector %d\r\n", position);
  e_send_uart1_char(text, strlen(text));

  switch (position) {
    case 0: running_light(); break;
    case 1: blinking_ring(); break;
    case 2: drive_straight(); break;
    case 3: spin(); break;
    default: show_position(position); break;
  }
  while (1);
}
