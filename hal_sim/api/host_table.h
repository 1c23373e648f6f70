// SPDX-License-Identifier: MIT
// The rows of host_table.inc, for who links images, and the sum by which an image says which
// table it was linked for.
#pragma once
#include <cstdint>

namespace api {

struct HostName {
  const char *driver, *name;
  bool is_shortcut = false;
};
struct HostRegister {
  const char *driver, *name;
  unsigned bytes;
};

#define HOST_FUNCTION(driver, name) {#driver, #name},
#define HOST_SHORTCUT(driver, name) {#driver, #name, true},
/// At their places.
inline constexpr HostName kHostFunctions[] = {
#include "hal_sim/api/host_table.inc"
};

#define HOST_REGISTER(driver, name, bytes) {#driver, #name, bytes},
/// In the order in which they lie.
inline constexpr HostRegister kHostRegisters[] = {
#include "hal_sim/api/host_table.inc"
};

#define HOST_OWNED(driver, name) {#driver, #name},
/// Registers and handlers of the drivers.
inline constexpr HostName kHostOwned[] = {
#include "hal_sim/api/host_table.inc"
};

/// Value of the symbol dspic::kHostTableSymbol: other rows give another one (FNV-1a).
constexpr std::uint32_t host_table_sum() {
  std::uint32_t sum = 0x811C9DC5;
  const auto add = [&sum](const char* text) {
    for (; *text; ++text) sum = (sum ^ static_cast<unsigned char>(*text)) * 0x01000193;
    sum = (sum ^ 0xFF) * 0x01000193;
  };
  for (const HostName& f : kHostFunctions) add(f.driver), add(f.name);
  for (const HostRegister& r : kHostRegisters) add(r.driver), add(r.name), sum = (sum ^ r.bytes) * 0x01000193;
  return sum;
}

}  // namespace api
