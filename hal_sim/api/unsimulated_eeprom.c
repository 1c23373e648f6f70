/* SPDX-License-Identifier: MIT
 * Data EEPROM of the processor.
 */
#include "DataEEPROM.h"
#include "unsimulated.h"
#define DEVICE "data EEPROM"

UNSIMULATED(int, ReadEE, (int Page, int Offset, int *DataOut, int Size))
UNSIMULATED(int, EraseEE, (int Page, int Offset, int Size))
UNSIMULATED(int, WriteEE, (int *DataIn, int Page, int Offset, int Size))
