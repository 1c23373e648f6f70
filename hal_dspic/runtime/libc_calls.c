/* SPDX-License-Identifier: MIT
 * Runtime of the chip: what the libc leaves to it (tp_runtime.h).
 */
#include <p30F6014A.h>
#include <stdio.h>
#include <tp_runtime.h>

void tp_reset(void)
{
  __asm__ volatile("reset");
  __builtin_unreachable();
}

/* a program that has given up starts anew, as with XC16 */
void tp_give_up(void) { tp_reset(); }

void tp_assert_failed(const char *file, int line, const char *text)
{
  printf("%s:%d: assert(%s) failed\n", file, line, text);
  tp_reset();
}

/* one that is off loses what it is given, and would never be ready for more */
void tp_console(const char *bytes, int length, int uart)
{
  for (; length > 0; length--, bytes++)
    if (uart == 2) {
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

unsigned tp_table_read(unsigned long address)
{
  const unsigned page = TBLPAG;
  unsigned word;
  TBLPAG = (unsigned)(address >> 16);
  word = __builtin_tblrdl((unsigned)address);
  TBLPAG = page;
  return word;
}
