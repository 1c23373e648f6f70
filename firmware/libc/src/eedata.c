/* SPDX-License-Identifier: MIT
 * Firmware libc: program memory and data EEPROM as the functions of libpic30.h reach them. */
/* of libpic30.h and DataEEPROM.h */
typedef unsigned long _prog_addressT;
enum { kRowBytes = 32, kRows = 128, kWord = 1, kRow = 16 };
int EraseEE(int page, int offset, int size);
int WriteEE(int *words, int page, int offset, int size);

#include <tp_runtime.h>

#define EEPROM 0x7FF000ul /* [DS70143 3.1] */

_prog_addressT _memcpy_p2d16(void *to, _prog_addressT from, unsigned int bytes)
{
  char *at = to;
  for (; bytes; bytes--, from++) {
    const unsigned word = tp_table_read(from & ~1ul);
    *at++ = (char)(from & 1 ? word >> 8 : word);
  }
  return from;
}

/* as on the robot: an operation is begun and goes on by itself for 2 ms, with NVMCON.WR set; what is asked for while
 * it runs does not happen, so programs call _wait_eedata() in between. The unlock sequence must not be interrupted.
 * [DS70143 7.0] */
#include <p30F6014A.h>

enum { ERASE_WORD = 0x4044, ERASE_ROW = 0x4045, ERASE_ALL = 0x4046, WRITE_WORD = 0x4004, WRITE_ROW = 0x4005 };

static void begin(unsigned operation)
{
  int saved;
  NVMCON = operation;
  SET_AND_SAVE_CPU_IPL(saved, 7);
  __builtin_write_NVM();
  RESTORE_CPU_IPL(saved);
}

static void set_latches(_prog_addressT at, const int *words, int count)
{
  const unsigned saved = TBLPAG;
  TBLPAG = (unsigned)(at >> 16);
  for (; count > 0; count--, at += 2) __builtin_tblwtl((unsigned)at, (unsigned)*words++);
  TBLPAG = saved;
}

static void point_at(_prog_addressT at)
{
  NVMADRU = (unsigned)(at >> 16);
  NVMADR = (unsigned)at;
}

void _erase_eedata(_prog_addressT at, int bytes)
{
  point_at(at);
  begin(bytes == kRowBytes ? ERASE_ROW : ERASE_WORD);
}
void _erase_eedata_all(void)
{
  point_at(EEPROM);
  begin(ERASE_ALL);
}
void _write_eedata_word(_prog_addressT at, int word)
{
  set_latches(at, &word, kWord);
  point_at(at);
  begin(WRITE_WORD);
}
void _write_eedata_row(_prog_addressT at, int *words)
{
  set_latches(at, words, kRow);
  point_at(at);
  begin(WRITE_ROW);
}
void _wait_eedata(void)
{
  while (NVMCONbits.WR) continue;
}
