/* SPDX-License-Identifier: MIT
 * Serial lines, 8 data bits, no parity, 1 stop bit. UART 1 is the Bluetooth module, UART 2 the RS232 plug and
 * the turret connector. Interrupts of priority 5 move the bytes. One byte takes 86.8 us at 115200 baud.
 *
 * Receiving: a ring of 64 bytes; when the program does not read, old bytes are overwritten silently.
 * Sending: the caller's buffer is sent from where it is. It must stay unchanged until e_uartN_sending() is 0.
 */
#ifndef _UART_TXRX_CHAR
#define _UART_TXRX_CHAR

#include "../twinpuck.h"

/* argument of e_init_uart2(), written straight to the baud-rate register: baud = 921600 / (n + 1) */
#define BAUD115200 7
#define BAUD230400 3
#define BAUD460800 1
#define BAUD921600 0

/** UART 1 at 115200 baud; empties the receive ring; allows nested interrupts. Does not block. */
void e_init_uart1(void);

/** Number of bytes waiting, 0 when none. */
int e_ischar_uart1();

/** 1 and the next byte in *car, or 0 and *car untouched. Does not block. */
int e_getchar_uart1(char *car);

/** Sends `length` bytes from `buff`. Blocks while an earlier transmission is still running, then returns at
 *  once while the bytes go out. length 0 counts down from 65536 and sends memory for 5.7 s.
 *  Called from an interrupt of priority 5 or above while a transmission is running, it never returns. */
void e_send_uart1_char(const char *buff, int length);

/** 1 while a transmission is running, else 0. */
int e_uart1_sending(void);

/** UART 2 at the given rate (BAUD115200, ...); otherwise as UART 1. */
void e_init_uart2(int baud);
#ifdef __TWINPUCK__
/** As older programs call it: 115200 baud. */
TP_OLDER_CALL void e_init_uart2(void) { e_init_uart2(BAUD115200); }
#endif
int e_ischar_uart2();
int e_getchar_uart2(char *car);
void e_send_uart2_char(const char *buff, int length);
int e_uart2_sending(void);

/** A byte received on a line can clear bits of a variable (a way to leave a loop); exists only when the
 *  library was assembled with UARTn_CLR_BIT_ON_INT. Not simulated: declared, never used. */
extern void *e_uart1_int_clr_addr;
extern int e_uart1_int_clr_mask;
extern void *e_uart2_int_clr_addr;
extern int e_uart2_int_clr_mask;

#endif
