/* SPDX-License-Identifier: MIT
 * What the programs of this folder share: they measure with timer 1 and report over UART 1, a line "name
 * value" each and "end" at last, so the same text comes from either HAL and from a robot on the table.
 */
#ifndef SAY_H
#define SAY_H
#include <p30F6014A.h>
#include <stdio.h>
#include <string.h>

#include <motor_led/e_init_port.h>
#include <uart/e_uart_char.h>

#define TICKS_PER_S 57600u /* timer 1 with prescaler 256 at 14.7456 MHz */

static void say(const char* name, long value) {
  char line[48];
  sprintf(line, "%s %ld\n", name, value);
  e_send_uart1_char(line, (int)strlen(line));
  while (e_uart1_sending()) continue;
}

static void start_clock(void) {
  T1CON = 0;
  TMR1 = 0;
  PR1 = 0xFFFF;
  T1CON = 0x8030;
}

/* 1000 at most */
static void pause_ms(unsigned int ms) {
  start_clock();
  while (TMR1 < (unsigned int)(ms * 576ul / 10)) continue;
}

static void begin(void) {
  e_init_port();
  e_init_uart1();
}

static void end(void) {
  static const char last[] = "end\n";
  e_send_uart1_char(last, 4);
  while (1) continue;
}
#endif
