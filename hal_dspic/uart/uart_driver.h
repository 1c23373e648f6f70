/* SPDX-License-Identifier: MIT
 * One UART's driver, for e_uart1.c and e_uart2.c. The includer defines UART_REG(name), UART_BITS(name), UART_NAME(e_)
 * and the flags, see there.
 *
 *   received words -> interrupt -> ring of 64 bytes -> e_getchar       two counters that only grow: nothing to lock
 *   caller's memory -> interrupt, up to four bytes at a time -> transmitter
 *
 * The transmitter interrupts when its FIFO runs empty (UTXISEL). The first byte goes straight to the shift register, so
 * the interrupt that loads the next four comes at once.
 * Kept from the original: the buffer is sent from where it is; a length of 0 counts down from 65536; bytes that nobody
 * takes are overwritten.
 * Source: [lib: uart/], facts restated; [DS70143 17].
 */
#ifndef HAL_DSPIC_UART_DRIVER_H
#define HAL_DSPIC_UART_DRIVER_H

#include "motor_led/e_epuck_ports.h"
#include "uart/e_uart_char.h"

#define RING_SIZE 64u
#define BURST 4
#define UART_PRIORITY 5

static volatile char ring[RING_SIZE];
static volatile unsigned int received; /* bytes ever received, 16 bits */
static volatile unsigned int taken;    /* bytes ever taken */

static const char *volatile next_byte; /* null when everything is loaded */
static volatile unsigned int left;     /* bytes still to load */
static volatile int is_sending;

void __attribute__((__interrupt__, __auto_psv__)) RX_HANDLER(void) {
  RX_FLAG = 0;
  while (UART_STA.URXDA) ring[received++ % RING_SIZE] = (char)UART_RXREG;
  if (UART_STA.OERR) UART_STA.OERR = 0; /* reception stands until it is cleared */
}

void __attribute__((__interrupt__, __auto_psv__)) TX_HANDLER(void) {
  unsigned char burst;
  TX_FLAG = 0;
  if (!is_sending) return;
  if (!next_byte || left == 0) {
    is_sending = 0;
    return;
  }
  for (burst = BURST; burst > 0 && !UART_STA.UTXBF; burst--) {
    if (left == 0) {
      next_byte = 0;
      return;
    }
    left--;
    UART_TXREG = (unsigned char)*next_byte;
    next_byte++;
  }
}

static void init_uart(unsigned int baud_register) {
  UART_MODE = 0;
  UART_STA_WORD = 0;
  UART_BRG = baud_register;
  received = taken = 0;
  RX_PRIORITY = UART_PRIORITY;
  TX_PRIORITY = UART_PRIORITY;
  INTCON1bits.NSTDIS = 0;
  RX_FLAG = 0;
  TX_FLAG = 0;
  RX_ENABLE = 1;
  TX_ENABLE = 1;
  UART_MODE = 0x8000; /* on, 8 bits, no parity, 1 stop bit */
  UART_STA.UTXISEL = 1;
  UART_STA.UTXEN = 1;
}

static int count_unread(void) { return (int)(received - taken); }

static int take_byte(char *car) {
  if (received == taken) return 0;
  *car = ring[taken % RING_SIZE];
  taken++;
  return 1;
}

static void begin_sending(const char *buff, int length) {
  while (is_sending) continue;
  next_byte = buff + 1;
  left = (unsigned int)length - 1;
  is_sending = 1;
  UART_TXREG = (unsigned char)*buff;
}

#endif
