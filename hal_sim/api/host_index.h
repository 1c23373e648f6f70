// SPDX-License-Identifier: MIT
// Numbers and places of host_table.inc's rows, for who plays them.
#pragma once
#include <cstddef>
#include <iterator>

#include "dspic30/memory/host_places.h"
#include "hal_sim/api/host_table.h"

namespace api {

/// Functions by their places in the table.
enum class HostFunction : unsigned {
#define HOST_FUNCTION(driver, name) name,
#include "hal_sim/api/host_table.inc"
};
inline constexpr std::size_t kHostFunctionCount = std::size(kHostFunctions);

/// The program address of a function.
inline constexpr unsigned host_place(HostFunction function) {
  return dspic::kHostStart + 2 * static_cast<unsigned>(function);
}

/// Variables that are served, by their places in the table.
enum class HostVariable : unsigned {
#define HOST_REGISTER(driver, name, bytes) name,
#include "hal_sim/api/host_table.inc"
  Count
};

inline constexpr unsigned kServedStart = 0x800;  ///< RAM's first address [DS70143 3.2]
/// The data address of a variable, each at an even one; of Count: where the last one ends.
inline constexpr unsigned served_address(HostVariable which) {
  unsigned address = kServedStart;
  for (std::size_t i = 0; i < static_cast<std::size_t>(which); ++i)
    address += (kHostRegisters[i].bytes + 1) & ~1u;
  return address;
}

}  // namespace api
