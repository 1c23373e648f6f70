/* SPDX-License-Identifier: MIT
 * Both UARTs under the names of Microchip's peripheral library: settings are masks, combined with &; functions that
 * send wait for room, those that receive do not wait. Source: bit fields [DS70143 17].
 */
#ifndef TWINPUCK_UART_H
#define TWINPUCK_UART_H
#ifndef __TWINPUCK__
#include_next <uart.h>
#else
#include "p30F6014A.h"

/* UxMODE */
#define UART_EN            0xFFFF
#define UART_DIS           0x7FFF
#define UART_IDLE_STOP     0xFFFF
#define UART_IDLE_CON      0xDFFF
#define UART_ALTRX_ALTTX   0xFFFF
#define UART_RX_TX         0xFBFF
#define UART_EN_WAKE       0xFFFF
#define UART_DIS_WAKE      0xFF7F
#define UART_EN_LOOPBACK   0xFFFF
#define UART_DIS_LOOPBACK  0xFFBF
#define UART_EN_ABAUD      0xFFFF
#define UART_DIS_ABAUD     0xFFDF
#define UART_NO_PAR_9BIT   0xFFFF
#define UART_ODD_PAR_8BIT  0xFFFD
#define UART_EVEN_PAR_8BIT 0xFFFB
#define UART_NO_PAR_8BIT   0xFFF9
#define UART_2STOPBITS     0xFFFF
#define UART_1STOPBIT      0xFFFE

/* UxSTA */
#define UART_INT_TX_BUF_EMPTY 0xFFFF
#define UART_INT_TX           0x7FFF
#define UART_TX_PIN_LOW       0xFFFF
#define UART_TX_PIN_NORMAL    0xF7FF
#define UART_TX_ENABLE        0xFFFF
#define UART_TX_DISABLE       0xFBFF
#define UART_INT_RX_BUF_FUL   0xFFFF
#define UART_INT_RX_3_4_FUL   0xFFBF
#define UART_INT_RX_CHAR      0xFF7F
#define UART_ADR_DETECT_EN    0xFFFF
#define UART_ADR_DETECT_DIS   0xFFDF
#define UART_RX_OVERRUN_CLEAR 0xFFFD

/* ConfigIntUARTx() */
#define UART_RX_INT_EN  0xFFFF
#define UART_RX_INT_DIS 0xFFF7
#define UART_RX_INT_PR0 0xFFF8
#define UART_RX_INT_PR1 0xFFF9
#define UART_RX_INT_PR2 0xFFFA
#define UART_RX_INT_PR3 0xFFFB
#define UART_RX_INT_PR4 0xFFFC
#define UART_RX_INT_PR5 0xFFFD
#define UART_RX_INT_PR6 0xFFFE
#define UART_RX_INT_PR7 0xFFFF
#define UART_TX_INT_EN  0xFFFF
#define UART_TX_INT_DIS 0xFF7F
#define UART_TX_INT_PR0 0xFF8F
#define UART_TX_INT_PR1 0xFF9F
#define UART_TX_INT_PR2 0xFFAF
#define UART_TX_INT_PR3 0xFFBF
#define UART_TX_INT_PR4 0xFFCF
#define UART_TX_INT_PR5 0xFFDF
#define UART_TX_INT_PR6 0xFFEF
#define UART_TX_INT_PR7 0xFFFF

#define TP_UART(n, flags, enables, priorities)                                                                        \
  static __inline__ void OpenUART##n(unsigned int mode, unsigned int status, unsigned int brg) {                      \
    U##n##BRG = brg;                                                                                                  \
    U##n##MODE = mode;                                                                                                \
    U##n##STA = status;                                                                                               \
  }                                                                                                                   \
  static __inline__ void CloseUART##n(void) {                                                                         \
    U##n##MODEbits.UARTEN = 0;                                                                                        \
    enables.U##n##RXIE = 0;                                                                                           \
    enables.U##n##TXIE = 0;                                                                                           \
    flags.U##n##RXIF = 0;                                                                                             \
    flags.U##n##TXIF = 0;                                                                                             \
  }                                                                                                                   \
  static __inline__ void ConfigIntUART##n(unsigned int config) {                                                      \
    flags.U##n##RXIF = 0;                                                                                             \
    flags.U##n##TXIF = 0;                                                                                             \
    priorities.U##n##RXIP = config & 7;                                                                               \
    priorities.U##n##TXIP = config >> 4 & 7;                                                                          \
    enables.U##n##RXIE = config >> 3 & 1;                                                                             \
    enables.U##n##TXIE = config >> 7 & 1;                                                                             \
  }                                                                                                                   \
  static __inline__ char BusyUART##n(void) { return !U##n##STAbits.TRMT; }                                            \
  static __inline__ char DataRdyUART##n(void) { return U##n##STAbits.URXDA; }                                         \
  static __inline__ unsigned int ReadUART##n(void) { return U##n##RXREG; }                                            \
  static __inline__ void WriteUART##n(unsigned int word) { U##n##TXREG = word; }                                      \
  static __inline__ void putsUART##n(unsigned int *text) {                                                            \
    char *c;                                                                                                          \
    for (c = (char *)text; *c; c++) {                                                                                 \
      while (U##n##STAbits.UTXBF) continue;                                                                           \
      U##n##TXREG = *c;                                                                                               \
    }                                                                                                                 \
  }                                                                                                                   \
  /* how many of `length` characters did not come: `wait` looks in vain end it */                                     \
  static __inline__ unsigned int getsUART##n(unsigned int length, unsigned int *buffer, unsigned int wait) {          \
    char *to = (char *)buffer;                                                                                        \
    unsigned int looks;                                                                                               \
    for (; length > 0; length--) {                                                                                    \
      for (looks = 0; !U##n##STAbits.URXDA; looks++)                                                                  \
        if (looks >= wait) return length;                                                                             \
      *to++ = (char)U##n##RXREG;                                                                                      \
    }                                                                                                                 \
    return 0;                                                                                                         \
  }
TP_UART(1, IFS0bits, IEC0bits, IPC2bits)
TP_UART(2, IFS1bits, IEC1bits, IPC6bits)

#endif
#endif
