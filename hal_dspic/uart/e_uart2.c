/* SPDX-License-Identifier: MIT
 * UART 2: see uart_driver.h.
 */
#define UART_MODE U2MODE
#define UART_STA_WORD U2STA
#define UART_STA U2STAbits
#define UART_BRG U2BRG
#define UART_RXREG U2RXREG
#define UART_TXREG U2TXREG
#define RX_HANDLER _U2RXInterrupt
#define TX_HANDLER _U2TXInterrupt
#define RX_FLAG IFS1bits.U2RXIF
#define TX_FLAG IFS1bits.U2TXIF
#define RX_ENABLE IEC1bits.U2RXIE
#define TX_ENABLE IEC1bits.U2TXIE
#define RX_PRIORITY IPC6bits.U2RXIP
#define TX_PRIORITY IPC6bits.U2TXIP

#include "uart_driver.h"

void e_init_uart2(int baud) { init_uart((unsigned int)baud); }

int e_ischar_uart2() { return count_unread(); }

int e_getchar_uart2(char *car) { return take_byte(car); }

void e_send_uart2_char(const char *buff, int length) { begin_sending(buff, length); }

int e_uart2_sending(void) { return is_sending; }
