/* SPDX-License-Identifier: MIT
 * Data EEPROM: what is written stays, erased words are ones. */
#include "say.h"
#include "DataEEPROM.h"

int main(void) {
  int word = 0x1234, read = 0;
  begin();
  EraseEE(0x7F, 0xF020, WORD);
  ReadEE(0x7F, 0xF020, &read, WORD);
  say("erased", read);
  WriteEE(&word, 0x7F, 0xF020, WORD);
  ReadEE(0x7F, 0xF020, &read, WORD);
  say("written", read);
  end();
}
