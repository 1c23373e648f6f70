/* SPDX-License-Identifier: MIT
 * Data EEPROM: reading, erasing and writing words and rows of 16 words.
 *
 * Modelled: what is kept, 2 ms for each erased or written word or row, arguments out of range. Not modelled: the
 * interrupts that the original's assembler holds back for the few instructions of its unlock sequence.
 * Source: [lib: DataEEPROM.s], facts restated; [DS70143 7.0].
 */
#include "DataEEPROM.h"

#include "hal_sim/host/pins.h"
#include "hal_sim/host/pins_eeprom.h"

#define PAGE 0x7F
#define FIRST 0xF000u
#define OPERATION_CYCLES 29491 /* 2 ms [DS70143 7.0: nominal] */

/* a word at an even place, or a row at its beginning */
static int is_place(int page, unsigned int offset, int size) {
  if (page != PAGE || offset < FIRST || (offset & 1)) return 0;
  return size == WORD || (size == ROW && (offset & 31) == 0);
}

int ReadEE(int Page, int Offset, int *DataOut, int Size) {
  unsigned int at = (unsigned int)Offset;
  int i;
  if (!is_place(Page, at, Size)) return ERROREE;
  for (i = 0; i < Size; i++) DataOut[i] = (int)tp_eeprom_read(at + 2u * i);
  return 0;
}

int EraseEE(int Page, int Offset, int Size) {
  unsigned int at = (unsigned int)Offset;
  long i, words = Size;
  if (Size == (int)ALL_EEPROM) {
    at = FIRST;
    words = 2048;
  } else if (!is_place(Page, at, Size)) {
    return ERROREE;
  }
  for (i = 0; i < words; i++) tp_eeprom_erase(at + 2 * i);
  tp_spend(OPERATION_CYCLES);
  return 0;
}

int WriteEE(int *DataIn, int Page, int Offset, int Size) {
  unsigned int at = (unsigned int)Offset;
  int i;
  if (!is_place(Page, at, Size)) return ERROREE;
  for (i = 0; i < Size; i++) tp_eeprom_write(at + 2u * i, (unsigned int)DataIn[i]);
  tp_spend(OPERATION_CYCLES);
  return 0;
}
