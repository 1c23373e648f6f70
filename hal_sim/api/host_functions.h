// SPDX-License-Identifier: MIT
// What the host functions' files share: how a program's function is known, registers of a call.
#pragma once
#include <cstdint>

#include "dspic30/memory/sfr_table.h"
#include "hal_sim/api/host_index.h"
#include "hal_sim/drivers/agenda_timer.h"

namespace api {

inline constexpr unsigned kIec0 = dspic::sfr("IEC0"), kIfs0 = dspic::sfr("IFS0");
inline constexpr board::Cycle kReturnCycles = 3;  // RETURN [DS70143 19.1]

/// What an agenda is known by: its function's program address. The null pointer is one, too.
inline constexpr unsigned kNullFunction = 1;  // no function is at an odd address
inline drivers::AgendaTimer::Function key_of(unsigned address) {
  // a key: nobody follows it
  return reinterpret_cast<drivers::AgendaTimer::Function>(  // NOLINT(performance-no-int-to-ptr)
      static_cast<std::uintptr_t>(address == 0 ? kNullFunction : address));
}
inline drivers::AgendaTimer::Function key_of(HostFunction function) { return key_of(host_place(function)); }
/// Where such a one is called; 0: none.
inline unsigned address_of(drivers::AgendaTimer::Function function) {
  return static_cast<unsigned>(reinterpret_cast<std::uintptr_t>(function));
}

}  // namespace api
