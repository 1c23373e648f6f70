/* SPDX-License-Identifier: MIT
 * Serial lines at 115200 baud, as the library named them before 2006. Behaviour is that of
 * uart/e_uart_char.h; the guard is shared with it.
 */
#ifndef _UART_TXRX_CHAR
#define _UART_TXRX_CHAR

#include "twinpuck.h"

/** UART 1, the Bluetooth module. Sending blocks while an earlier transmission is running. */
void InitUart1(void);
int GetcharUart1(char *car);
void SendUart1Char(char *buff, int lenght);

/** UART 2, the RS232 plug. */
void InitUart2(void);
int GetcharUart2(char *car);
void SendUart2Char(char *buff, int lenght);

#endif
