/* SPDX-License-Identifier: MIT
 * Firmware libc: program memory and data EEPROM as the functions of libpic30.h reach them. */
/* of libpic30.h and DataEEPROM.h */
typedef unsigned long _prog_addressT;
enum { kRowBytes = 32, kRows = 128, kWord = 1, kRow = 16 };
int EraseEE(int page, int offset, int size);
int WriteEE(int *words, int page, int offset, int size);

unsigned tp_image_table_read(unsigned long address); /* of the way that runs the program */

#define EEPROM 0x7FF000ul /* [DS70143 3.1] */

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
