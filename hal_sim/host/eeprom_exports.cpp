// SPDX-License-Identifier: MIT
// pins_eeprom.h on the board.
#include "hal_sim/board/board.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins_eeprom.h"

using host::Context;

extern "C" {

tp_i64 tp_eeprom_read(tp_i64 address) {
  return Context::current().board().eeprom().read(static_cast<unsigned>(address) & 0xFFFE);
}

void tp_eeprom_write(tp_i64 address, tp_i64 value) {
  Context& context = Context::current();
  context.board().eeprom().write(static_cast<unsigned>(address) & 0xFFFE, static_cast<std::uint16_t>(value));
  context.note_write();
}

void tp_eeprom_erase(tp_i64 address) {
  Context& context = Context::current();
  context.board().eeprom().erase(static_cast<unsigned>(address) & 0xFFFE);
  context.note_write();
}

}  // extern "C"
