// SPDX-License-Identifier: MIT
// The chip's registers by address: name, implemented bits, reset value, fields. Generated rows (sfr_rows.inc)
// from device/sfr.csv; a register with a second name (C1RERRCNT) is listed under its first one.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dspic {

inline constexpr unsigned kSfrBytes = 0x800;

struct SfrInfo {
  std::uint16_t address;
  const char* name;
  std::uint16_t implemented;  ///< bits that exist; the others read 0
  std::uint16_t reset;        ///< value at power-on
  bool defined;               ///< false: the chip comes up with anything; here 0
  const char* fields;         ///< "TCS:1:1 TSYNC:2:1 ...": name, lowest bit, width
};

inline constexpr SfrInfo kSfrRows[] = {
#include "dspic30/memory/sfr_rows.inc"
};

namespace detail {
[[noreturn]] void no_such_register();  // aborts; no constant calls it
}

/// Address of the register of that name, for constants.
constexpr unsigned sfr(std::string_view name) {
  for (const SfrInfo& row : kSfrRows)
    if (name == row.name) return row.address;
  detail::no_such_register();
  return 0;
}

/// Register at a byte address (the odd byte belongs to its word); null where nothing is.
const SfrInfo* sfr_info(unsigned address);
/// Register of that name; null for unknown ones.
const SfrInfo* sfr_named(const std::string& name);
/// A field: bits `bit` to `bit + width - 1`.
struct SfrField {
  std::string name;
  int bit = 0, width = 0;
};
/// In the table's order; none where no field is named.
std::vector<SfrField> fields_of(const SfrInfo& info);
/// "U1MODE.LPBACK", "TCKPS1" style for fields of several bits ("T1CON.TCKPS"), "PR1.3" where no field is
/// named.
std::string sfr_bit_name(const SfrInfo& info, int bit);

}  // namespace dspic
