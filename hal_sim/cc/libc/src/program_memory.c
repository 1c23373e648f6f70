/* SPDX-License-Identifier: MIT
 * Firmware libc: program memory and data EEPROM as table instructions and libpic30.h reach them. Variables of
 * section tpeedata (_EEDATA, space(eedata)) lie in the EEPROM, in their order from its first word on. Everything
 * else has a program address of its own by which it is read, two bytes to an address as psv data on the chip; not
 * modelled: the window into program memory through pointers that are made of numbers (PSVPAG). */
#include "hal_sim/host/image_abi.h"

/* of libpic30.h and DataEEPROM.h */
typedef unsigned long _prog_addressT;
enum { kRowBytes = 32, kRows = 128, kWord = 1, kRow = 16 };
int EraseEE(int page, int offset, int size);
int WriteEE(int *words, int page, int offset, int size);

extern const char tp_text_begin[], tp_data_end[];     /* the linker script */
extern const char tp_eedata_begin[], tp_eedata_end[];

#define EEPROM 0x7FF000ul     /* [DS70143 3.1] */
#define CONSTANTS 0x010000ul  /* behind the vectors and whatever else the program might look for */

unsigned long tp_image_program_address(const volatile void *object)
{
  const char *at = (const char *)object;
  if (at >= tp_eedata_begin && at < tp_eedata_end) return EEPROM + (unsigned long)(at - tp_eedata_begin);
  return CONSTANTS + (unsigned long)((unsigned long long)at - (unsigned long long)tp_text_begin);
}

unsigned tp_image_table_read(unsigned long address)
{
  const char *at = tp_text_begin + (address - CONSTANTS);
  if (address >= EEPROM) return (unsigned)tp_table_read((tp_i64)address);
  if (address < CONSTANTS || at >= tp_data_end) return 0xFFFF; /* as erased program memory */
  return (unsigned char)at[0] | (unsigned)(unsigned char)at[1] << 8;
}

_prog_addressT _memcpy_p2d16(void *to, _prog_addressT from, unsigned int bytes)
{
  char *at = to;
  for (; bytes; bytes--, from++) {
    const unsigned word = tp_image_table_read(from & ~1ul);
    *at++ = (char)(from & 1 ? word >> 8 : word);
  }
  return from;
}

/* the functions of the library for one word or one row wait until it is done */
static int size_of(int bytes) { return bytes == kRowBytes ? kRow : kWord; }

void _erase_eedata(_prog_addressT at, int bytes) { EraseEE((int)(at >> 16), (int)at, size_of(bytes)); }
void _erase_eedata_all(void) {
  int row;
  for (row = 0; row < kRows; row++) EraseEE((int)(EEPROM >> 16), (int)(EEPROM + (unsigned)row * kRowBytes), kRow);
}
void _write_eedata_word(_prog_addressT at, int word) { WriteEE(&word, (int)(at >> 16), (int)at, kWord); }
void _write_eedata_row(_prog_addressT at, int *words) { WriteEE(words, (int)(at >> 16), (int)at, kRow); }
void _wait_eedata(void) {}
