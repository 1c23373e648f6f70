// SPDX-License-Identifier: MIT
// What programs in messages.txt include that show what beginners get wrong.
#include <a_d/advance_ad_scan/e_ad_conv.h>
#include <a_d/advance_ad_scan/e_prox.h>
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_epuck_ports.h>
#include <motor_led/e_init_port.h>
#include <p30F6014A.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <uart/e_uart_char.h>
#define HANDLER void __attribute__((interrupt, auto_psv))
#define TIMER_1 (T1CON = 0x8000, PR1 = 10000, IEC0bits.T1IE = 1)
