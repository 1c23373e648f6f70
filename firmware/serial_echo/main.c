/* SPDX-License-Identifier: MIT
 * Serial echo: a line-by-line command parser on UART 1 (Bluetooth), in the manner of the robot's serial protocol.
 *
 *   D,l,r   speeds, steps/s                    answer d
 *   L,n,v   ring LED n: 0 off, 1 on, 2 toggle   answer l
 *   Q       step counters                      answer q,left,right
 *   C       selector                           answer c,position
 *   anything else comes back unchanged
 *
 * A line ends with CR or LF.
 */
#include <motor_led/advance_one_timer/e_agenda.h>
#include <motor_led/advance_one_timer/e_led.h>
#include <motor_led/advance_one_timer/e_motors.h>
#include <motor_led/e_init_port.h>
#include <stdio.h>
#include <string.h>
#include <uart/e_uart_char.h>
#include <utility/utility.h>

#define LINE 60

/* The driver sends from the caller's memory: wait until it has finished before the text may change. */
static void send(const char *text) {
  e_send_uart1_char(text, strlen(text));
  while (e_uart1_sending());
}

/* Reads one line without its end, at most LINE - 1 characters; the rest of a longer line is dropped. */
static void read_line(char *line) {
  int length = 0;
  char c;
  while (1) {
    while (!e_getchar_uart1(&c));
    if (c == '\r' || c == '\n') {
      if (length == 0) continue; /* an empty line, or the LF of CR LF */
      line[length] = '\0';
      return;
    }
    if (length < LINE - 1) line[length++] = c;
  }
}

static void obey(const char *line) {
  static char answer[LINE + 4];
  int a, b;
  if (sscanf(line, "D,%d,%d", &a, &b) == 2) {
    e_set_speed_left(a);
    e_set_speed_right(b);
    strcpy(answer, "d\r\n");
  } else if (sscanf(line, "L,%d,%d", &a, &b) == 2) {
    e_set_led(a, b);
    strcpy(answer, "l\r\n");
  } else if (strcmp(line, "Q") == 0) {
    sprintf(answer, "q,%d,%d\r\n", e_get_steps_left(), e_get_steps_right());
  } else if (strcmp(line, "C") == 0) {
    sprintf(answer, "c,%d\r\n", getselector());
  } else {
    sprintf(answer, "%s\r\n", line);
  }
  send(answer);
}

int main(void) {
  static char line[LINE];
  e_init_port();
  e_start_agendas_processing();
  e_init_motors();
  e_init_uart1();

  send("serial_echo ready\r\n");
  while (1) {
    read_line(line);
    obey(line);
  }
}
