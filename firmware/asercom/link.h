/* SPDX-License-Identifier: MIT
 * The serial line that commands come from: UART 1 (Bluetooth, 115,200 baud) or UART 2 (turret connector,
 * 230,400 baud). One of them for the whole life of the program.
 */
#ifndef ASERCOM_LINK_H
#define ASERCOM_LINK_H

#include <uart/e_uart_char.h>

#define LINK_RING 64u /* bytes that the driver keeps */

extern char link_turret; /* set by link_open() */

/** Chooses the line and sets it up. second_uart 0: UART 1, already set up by the caller; else UART 2. */
void link_open(int second_uart);

/** 1 when the line is UART 2: camera, I2C and sound then belong to the computer on the turret. */
static __inline__ int link_is_turret(void) { return link_turret; }

/** 1 and the next byte in *c, or 0. Does not block. When the program was busy for so long that the driver's
 *  ring of 64 bytes was overwritten, what was overwritten is skipped, so that nothing is read twice. */
static __inline__ int link_poll(char *c) {
  /* the driver's counters are free-running: more than the ring holds means overwritten */
  unsigned int waiting = link_turret ? e_ischar_uart2() : e_ischar_uart1();
  while (waiting > LINK_RING) {
    link_turret ? e_getchar_uart2(c) : e_getchar_uart1(c);
    waiting--;
  }
  return link_turret ? e_getchar_uart2(c) : e_getchar_uart1(c);
}

/** The next byte; blocks until there is one. */
char link_get(void);

/** Sends and waits until the last byte is on its way: the buffer may then change. Length 0: nothing. */
void link_send(const char *bytes, int length);

/** Sends a text, without its terminating zero. */
void link_text(const char *text);

#endif
