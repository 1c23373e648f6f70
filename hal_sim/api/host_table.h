// SPDX-License-Identifier: MIT
// Names, places and numbers of what hal_sim fills of the library: host_table.inc as constants.
#pragma once
#include <cstddef>
#include <cstdint>

#include "dspic30/memory/host_places.h"

namespace api {

/// A driver is filled as a whole or not at all.
enum class Driver : std::uint8_t { agenda, scan };

/// By their places in the table.
enum class HostFunction : unsigned {
#define HOST_FUNCTION(driver, name) name,
#define HOST_REGISTER(driver, name, bytes)
#include "hal_sim/api/host_table.inc"
#undef HOST_FUNCTION
#undef HOST_REGISTER
  Count
};
inline constexpr std::size_t kHostFunctions = static_cast<std::size_t>(HostFunction::Count);

struct HostFunctionRow {
  Driver driver;
  const char* name;
};
inline constexpr HostFunctionRow kHostFunctionRows[] = {
#define HOST_FUNCTION(driver, name) {Driver::driver, #name},
#define HOST_REGISTER(driver, name, bytes)
#include "hal_sim/api/host_table.inc"
#undef HOST_FUNCTION
#undef HOST_REGISTER
};

/// The program address of a function.
inline constexpr unsigned host_place(HostFunction function) {
  return dspic::kHostStart + 2 * static_cast<unsigned>(function);
}

enum class HostRegister : unsigned {
#define HOST_FUNCTION(driver, name)
#define HOST_REGISTER(driver, name, bytes) name,
#include "hal_sim/api/host_table.inc"
#undef HOST_FUNCTION
#undef HOST_REGISTER
  Count
};
inline constexpr std::size_t kHostRegisters = static_cast<std::size_t>(HostRegister::Count);

struct HostRegisterRow {
  Driver driver;
  const char* name;
  unsigned bytes;
};
inline constexpr HostRegisterRow kHostRegisterRows[] = {
#define HOST_FUNCTION(driver, name)
#define HOST_REGISTER(driver, name, bytes) {Driver::driver, #name, bytes},
#include "hal_sim/api/host_table.inc"
#undef HOST_FUNCTION
#undef HOST_REGISTER
};

inline constexpr unsigned kServedStart = 0x800;  ///< RAM's first address [DS70143 3.2]
/// The data address of a register, each at an even one; of Count: where the last one ends.
inline constexpr unsigned served_address(HostRegister which) {
  unsigned address = kServedStart;
  for (std::size_t i = 0; i < static_cast<std::size_t>(which); ++i)
    address += (kHostRegisterRows[i].bytes + 1) & ~1u;
  return address;
}
inline constexpr unsigned kServedEnd = served_address(HostRegister::Count);

}  // namespace api
