/* SPDX-License-Identifier: MIT */
/* @NAME@: drives forward and turns away from what the front sensors see. */
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>

#define CRUISE 400 /* steps/s; 1000 is one wheel turn a second */
#define NEAR 300   /* counts; about 3 cm from a white wall */

static volatile int step_due;

/* every 20 ms, from the agenda's interrupt */
static void tick(void)
{
  step_due = 1;
}

static void control_step(void)
{
  int right = e_get_prox(0) + e_get_prox(1);
  int left = e_get_prox(7) + e_get_prox(6);

  if (right < NEAR && left < NEAR) {
    e_set_speed_left(CRUISE);
    e_set_speed_right(CRUISE);
  } else if (right > left) {
    e_set_speed_left(-CRUISE / 2);
    e_set_speed_right(CRUISE / 2);
  } else {
    e_set_speed_left(CRUISE / 2);
    e_set_speed_right(-CRUISE / 2);
  }
  e_set_led(0, 2); /* the other way round each time */
}

int main(void)
{
  e_init_port();
  e_init_uart1();
  e_start_agendas_processing();
  e_init_motors();
  e_init_ad_scan(ALL_ADC);
  e_activate_agenda(tick, 200); /* 200 ticks of 0.1 ms */
  e_send_uart1_char("ready\r\n", 7);
  while (1) {
    while (!step_due)
      ;
    step_due = 0;
    control_step();
  }
}
