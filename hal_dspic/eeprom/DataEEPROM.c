/* SPDX-License-Identifier: MIT
 * Data EEPROM: reading, erasing and writing words and rows of 16 words.
 * The unlock sequence must not be interrupted, so it runs at priority 7.
 * Source: [lib: DataEEPROM.s], facts restated; [DS70143 7.0].
 */
#include "DataEEPROM.h"

#include "hal.h"

#define PAGE 0x7F
#define FIRST 0xF000u
#define ERASE_WORD 0x4044
#define ERASE_ROW 0x4045
#define ERASE_ALL 0x4046
#define WRITE_WORD 0x4004
#define WRITE_ROW 0x4005

/* a word at an even place, or a row at its beginning */
static int is_place(int page, unsigned int offset, int size) {
  if (page != PAGE || offset < FIRST || (offset & 1)) return 0;
  return size == WORD || (size == ROW && (offset & 31) == 0);
}

static void carry_out(unsigned int operation) {
  int saved;
  NVMCON = operation;
  SET_AND_SAVE_CPU_IPL(saved, 7);
  __builtin_write_NVM();
  RESTORE_CPU_IPL(saved);
  while (NVMCONbits.WR) continue;
}

int ReadEE(int Page, int Offset, int *DataOut, int Size) {
  unsigned int at = (unsigned int)Offset;
  int i;
  if (!is_place(Page, at, Size)) return ERROREE;
  for (i = 0; i < Size; i++) DataOut[i] = hal_eeprom_word(at + 2u * (unsigned int)i);
  return 0;
}

int EraseEE(int Page, int Offset, int Size) {
  unsigned int at = (unsigned int)Offset;
  unsigned int operation = Size == WORD ? ERASE_WORD : ERASE_ROW;
  if (Size == (int)ALL_EEPROM) {
    at = FIRST;
    operation = ERASE_ALL;
  } else if (!is_place(Page, at, Size)) {
    return ERROREE;
  }
  NVMADRU = PAGE;
  NVMADR = at;
  carry_out(operation);
  return 0;
}

int WriteEE(int *DataIn, int Page, int Offset, int Size) {
  unsigned int at = (unsigned int)Offset;
  unsigned int saved = TBLPAG;
  int i;
  if (!is_place(Page, at, Size)) return ERROREE;
  TBLPAG = PAGE;
  for (i = 0; i < Size; i++) __builtin_tblwtl(at + 2u * (unsigned int)i, (unsigned int)DataIn[i]);
  TBLPAG = saved;
  NVMADRU = PAGE;
  NVMADR = at;
  carry_out(Size == WORD ? WRITE_WORD : WRITE_ROW);
  return 0;
}
