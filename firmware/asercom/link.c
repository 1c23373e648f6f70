/* SPDX-License-Identifier: MIT
 * See link.h.
 */
#include "link.h"

#include <string.h>

char link_turret;

void link_open(int second_uart) {
  link_turret = second_uart != 0;
  if (link_turret) e_init_uart2(BAUD230400);
}

char link_get(void) {
  char c;
  while (!link_poll(&c));
  return c;
}

void link_send(const char *bytes, int length) {
  if (length <= 0) return; /* the driver would send 65,536 bytes */
  if (link_turret) {
    e_send_uart2_char(bytes, length);
    while (e_uart2_sending());
  } else {
    e_send_uart1_char(bytes, length);
    while (e_uart1_sending());
  }
}

void link_text(const char *text) { link_send(text, (int)strlen(text)); }
