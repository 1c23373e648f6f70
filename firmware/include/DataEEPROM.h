/* SPDX-License-Identifier: MIT
 * Data EEPROM of the processor: 4096 bytes at 0x7FF000, so page 0x7F, offsets 0xF000 to 0xFFFE.
 * All return 0 for success, -1 (ERROREE) for arguments that make no sense. `Size` is one of the three below.
 */

#define WORD 1             /* one word, 2 bytes */
#define ROW 16             /* a row of 16 words, aligned to 32 bytes */
#define ALL_EEPROM 0xFFFF  /* erase everything */
#define ERROREE -1

/** Reads a word or a row. Does not block. The word at 0x7FFFFE describes the hardware revision. */
extern int ReadEE(int Page, int Offset, int *DataOut, int Size);

/** Erases (to 0xFFFF) a word, a row or everything. Blocks for about 2 ms. */
extern int EraseEE(int Page, int Offset, int Size);

/** Writes a word or a row, which must have been erased. Blocks for about 2 ms. */
extern int WriteEE(int *DataIn, int Page, int Offset, int Size);
