/* SPDX-License-Identifier: MIT
 * UART 1: see uart_driver.h.
 */
#define UART_MODE U1MODE
#define UART_STA_WORD U1STA
#define UART_STA U1STAbits
#define UART_BRG U1BRG
#define UART_RXREG U1RXREG
#define UART_TXREG U1TXREG
#define RX_HANDLER _U1RXInterrupt
#define TX_HANDLER _U1TXInterrupt
#define RX_FLAG IFS0bits.U1RXIF
#define TX_FLAG IFS0bits.U1TXIF
#define RX_ENABLE IEC0bits.U1RXIE
#define TX_ENABLE IEC0bits.U1TXIE
#define RX_PRIORITY IPC2bits.U1RXIP
#define TX_PRIORITY IPC2bits.U1TXIP

#include "uart_driver.h"

void e_init_uart1(void) { init_uart(BAUD115200); }

int e_ischar_uart1() { return count_unread(); }

int e_getchar_uart1(char *car) { return take_byte(car); }

void e_send_uart1_char(const char *buff, int length) { begin_sending(buff, length); }

int e_uart1_sending(void) { return is_sending; }
