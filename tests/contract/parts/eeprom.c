/* SPDX-License-Identifier: MIT
 * Data EEPROM: what is written stays, erased words are ones. */
#include "say.h"
#include "DataEEPROM.h"

int main(void) {
  int word = 0x1234, read = 0, i, row[ROW], back[ROW];
  begin();
  EraseEE(0x7F, 0xF020, WORD);
  ReadEE(0x7F, 0xF020, &read, WORD);
  say("erased", read);
  WriteEE(&word, 0x7F, 0xF020, WORD);
  ReadEE(0x7F, 0xF020, &read, WORD);
  say("written", read);
  /* a row begins at a multiple of 32, a word at an even place, and nothing but the EEPROM is one */
  for (i = 0; i < ROW; i++) row[i] = 100 + i;
  EraseEE(0x7F, 0xF040, ROW);
  TBLPAG = 0x12;
  say("row", WriteEE(row, 0x7F, 0xF040, ROW));
  say("page", TBLPAG);
  ReadEE(0x7F, 0xF040, back, ROW);
  say("first", back[0]);
  say("last", back[ROW - 1]);
  say("odd", WriteEE(&word, 0x7F, 0xF041, WORD));
  say("middle", WriteEE(row, 0x7F, 0xF042, ROW));
  say("elsewhere", ReadEE(0x7E, 0xF040, &read, WORD));
  say("before", ReadEE(0x7F, 0xEFFE, &read, WORD));
  say("size", EraseEE(0x7F, 0xF040, 2));
  ReadEE(0x7F, 0xF040, back, ROW);
  say("still", back[1]);
  end();
}
