// SPDX-License-Identifier: MIT
// The functions of pins_virtual.h on the board.
#include <algorithm>
#include <cstring>

#include "hal_sim/board/board.h"
#include "hal_sim/host/context.h"
#include "hal_sim/host/pins_virtual.h"

extern "C" {

void tp_virtual_console(const char* bytes, tp_i64 length) {
  host::Context& context = host::Context::current();
  context.note_write();
  constexpr tp_i64 kLongestText = 1 << 16;
  if (length > 0)
    context.board().virtual_devices().write(bytes, static_cast<std::size_t>(std::min(length, kLongestText)));
}

tp_i64 tp_virtual_sensor(const char* name, tp_f32* value) {
  host::Context& context = host::Context::current();
  context.lower_horizon(context.now());
  // no std::string from a null pointer, which throws: a fault tells who read it
  const auto found = context.board().virtual_devices().get(std::string(name, std::strlen(name)));
  if (!found) return 0;
  *value = static_cast<float>(*found);
  return 1;
}

}  // extern "C"
