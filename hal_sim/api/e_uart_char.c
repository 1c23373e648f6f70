/* SPDX-License-Identifier: MIT
 * UART 1 and 2. Bytes are taken from the caller's memory when the transmit interrupt loads them, up to four
 * at a time, so a buffer that is overwritten too early is sent overwritten, as on the robot.
 *
 * Modelled: blocking while a transfer is under way, the first byte loaded at once, 64-byte receive ring.
 * Not modelled: what a length of 0 or less sends after its first byte: the robot goes through its whole
 * memory, here 65,536 bytes less the length are 0. Clearing a variable's bits on reception (a build option).
 * Source: [lib: uart/], facts restated.
 */
#include "uart/e_uart_char.h"

#include "hal_sim/api/takes.h"
#include "hal_sim/host/pins.h"

#define UART_PRIORITY 5
#define BURST 4 /* bytes an interrupt loads */
#define BYTE_CYCLES ((T_UART_BURST - T_UART_END) / BURST)

/* one transmitter: the assembler variables of the library */
struct transmitter {
  const char *next;       /* 0 when everything is loaded */
  unsigned int left;      /* bytes still to load */
  volatile int busy;      /* what e_uartN_sending() answers */
  char beyond;            /* length 0 or less: no buffer to read from */
};

static struct transmitter uart1, uart2;

TAKES(0) static void load_burst(struct transmitter *t, int number) {
  unsigned char burst = BURST;
  if (!t->busy) return;
  if (!t->next || t->left == 0) {
    t->busy = 0;
    return;
  }
  while (burst-- > 0) {
    if (t->left == 0) {
      t->next = 0;
      return;
    }
    t->left--;
    tp_spend(BYTE_CYCLES);
    tp_uart_load(number, t->beyond ? 0 : (unsigned char)*t->next);
    if (!t->beyond) t->next++;
  }
}

TAKES(0) static void serve_uart1(void) { load_burst(&uart1, 1); }

TAKES(0) static void serve_uart2(void) { load_burst(&uart2, 2); }

static void begin(struct transmitter *t, int number, const char *buff, int length) {
  while (t->busy) continue;
  t->left = (unsigned int)length - 1;
  t->beyond = length <= 0;
  t->next = t->beyond ? buff : buff + 1;
  t->busy = 1;
  tp_uart_load(number, (unsigned char)*buff);
}

static int take(int number, char *car) {
  int byte = (int)tp_uart_take(number);
  if (byte < 0) return 0;
  *car = (char)byte;
  return 1;
}

void e_init_uart1(void) {
  tp_spend(T_INIT_UART);
  tp_irq_install(TP_V_U1TX, serve_uart1, UART_PRIORITY, T_UART_END);
  tp_uart_init(1, BAUD115200);
}

int e_ischar_uart1() { return (int)tp_uart_unread(1); }

int e_getchar_uart1(char *car) { return take(1, car); }

void e_send_uart1_char(const char *buff, int length) { begin(&uart1, 1, buff, length); }

int e_uart1_sending(void) { return uart1.busy; }

void e_init_uart2(int baud) {
  tp_spend(T_INIT_UART);
  tp_irq_install(TP_V_U2TX, serve_uart2, UART_PRIORITY, T_UART_END);
  tp_uart_init(2, baud);
}

int e_ischar_uart2() { return (int)tp_uart_unread(2); }

int e_getchar_uart2(char *car) { return take(2, car); }

void e_send_uart2_char(const char *buff, int length) { begin(&uart2, 2, buff, length); }

int e_uart2_sending(void) { return uart2.busy; }
