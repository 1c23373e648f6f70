/* SPDX-License-Identifier: MIT
 * Runtime of the chip: what the libc asks of the host on a PC (hal_sim/host/image_abi.h), done by the chip itself.
 */
#include <p30F6014A.h>
#include <stdio.h>
#include <stdlib.h>
#include "hal_sim/host/image_abi.h"

void tp_reset(void)
{
  __asm__ volatile("reset");
}

/* a program that has given up starts anew, as with XC16 */
void tp_trap_message(tp_i64 kind, const char *message) { tp_reset(); }

void tp_image_assert(const char *file, int line, const char *text)
{
  printf("%s:%d: assert(%s) failed\n", file, line, text);
  tp_reset();
}

/* to the UART, which the program has set up; one that is off loses what it is given, and would never be ready for more */
void tp_console(const char *bytes, tp_i64 length, tp_i64 uart)
{
  int n = (int)length;
  for (; n > 0; n--, bytes++)
    if ((int)uart == 2) {
      while (U2MODEbits.UARTEN && U2STAbits.UTXBF) {
      }
      U2TXREG = (unsigned char)*bytes;
      if (!U2MODEbits.UARTEN) return;
    } else {
      while (U1MODEbits.UARTEN && U1STAbits.UTXBF) {
      }
      U1TXREG = (unsigned char)*bytes;
      if (!U1MODEbits.UARTEN) return;
    }
}

/* the example of the C standard (7.20.2.2), which XC16's library uses as well */
static unsigned long random_state = 1;

void tp_srand(tp_i64 seed) { random_state = (unsigned long)seed; }

tp_i64 tp_rand(void)
{
  random_state = random_state * 1103515245ul + 12345ul;
  return (int)(random_state >> 16) & RAND_MAX;
}

/* a word of program memory or data EEPROM */
unsigned tp_image_table_read(unsigned long address)
{
  const unsigned page = TBLPAG;
  unsigned word;
  TBLPAG = (unsigned)(address >> 16);
  word = __builtin_tblrdl((unsigned)address);
  TBLPAG = page;
  return word;
}
